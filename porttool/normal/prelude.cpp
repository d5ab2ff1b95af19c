// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/prelude.h"

#include <algorithm>
#include <unordered_set>

#include "porttool/language/language.h"
#include "porttool/normal/normal_form.h"

namespace porttool {
namespace {

/// Where the prelude of a text ends. It begins and ends with an empty statement, as no unit does.
Words::const_iterator end_of_prelude(const Words& text) {
    if (text.size() < 4 || text[0] != ";" || text[1] != ";") return text.begin();
    for (auto at = text.begin() + 3; at != text.end(); ++at)
        if (*at == ";" && *(at - 1) == ";") return at + 1;
    return text.begin();
}

}  // namespace

void write_prelude(const ScannedFile& file, const Unit& unit, const std::vector<uint32_t>& places,
                   const std::function<void(std::string_view word)>& sink) {
    if (file.variables.empty() || (unit.kind != UnitKind::Function && unit.kind != UnitKind::Kernel)) return;
    constexpr size_t kMost = 64;
    const LexedText& lexed = file.lexed;
    std::unordered_set<std::string_view> seen;
    for (const uint32_t place : places) seen.insert(lexed.view(place));
    std::vector<TokenRange> found;
    const auto look_up = [&](std::string_view name) {
        const auto less = [&](const FileVariable& variable, std::string_view text) {
            return lexed.view(variable.name_token) < text;
        };
        auto at = std::lower_bound(file.variables.begin(), file.variables.end(), name, less);
        for (; at != file.variables.end() && lexed.view(at->name_token) == name && found.size() < kMost; ++at)
            found.push_back(at->tokens);
    };
    if (unit.kind == UnitKind::Kernel && !traits_of(file.language).entry_point.empty()) look_up("layout");
    for (uint32_t i = unit.body.first; i < unit.body.end && found.size() < kMost; ++i) {
        const Token& token = lexed.tokens[i];
        if (token.kind != TokenKind::Identifier || (token.flags & kDead) != 0) continue;
        const std::string_view before = i > 0 ? lexed.view(i - 1) : std::string_view();
        if (before == "." || before == "->" || !seen.insert(lexed.view(token)).second) continue;
        look_up(lexed.view(token));
    }
    std::sort(found.begin(), found.end(), [](TokenRange a, TokenRange b) { return a.first < b.first; });
    for (int i = 0; i < 2 && !found.empty(); ++i) sink(";");
    uint32_t last = 0;
    for (const TokenRange range : found) {
        if (range.first < last) continue;  // two names of one declaration
        last = range.end;
        for (uint32_t i = range.first; i < range.end; ++i) {
            const Token& token = lexed.tokens[i];
            if ((token.flags & (kDead | kInDirective)) != 0) continue;
            if (token.kind == TokenKind::String || token.kind == TokenKind::Character) continue;
            if (lexed.view(token).find_first_of("\x01\x02") != std::string_view::npos) continue;  // not as recorded
            if (token.kind == TokenKind::Number)
                sink(normal_number(lexed.view(token)));
            else
                sink(lexed.view(token));
        }
        sink(";");
    }
    if (!found.empty()) sink(";");
}

Words prelude_of(const Words& text) { return {text.begin(), end_of_prelude(text)}; }

Words without_prelude(const Words& text) { return {end_of_prelude(text), text.end()}; }

}  // namespace porttool
