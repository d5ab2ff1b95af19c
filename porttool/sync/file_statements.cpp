// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/file_statements.h"

#include <algorithm>

#include "porttool/sync/unit_extent.h"

namespace porttool {
namespace {

constexpr size_t kMostStatements = 4000;

/// The name before the first `(`, `[`, `=` or `;`, and whether it is a function's.
void name_statement(const LexedText& lexed, FileStatement& out) {
    for (uint32_t i = out.tokens.first + 1; i < out.tokens.end; ++i) {
        const std::string_view word = lexed.view(i);
        if (word != "(" && word != "[" && word != "=" && word != ";") continue;
        const Token& name = lexed.tokens[i - 1];
        // `a = f ( )` and macros alone declare nothing.
        const bool declares = i > out.tokens.first + 1 && name.kind == TokenKind::Identifier;
        if (declares) out.name = lexed.view(name);
        out.name_token = i - 1;
        out.is_function = declares && word == "(";
        return;
    }
}

}  // namespace

std::vector<FileStatement> file_statements(const ScannedFile& file) {
    const LexedText& lexed = file.lexed;
    std::vector<FileStatement> out;
    const uint32_t count = static_cast<uint32_t>(lexed.tokens.size());
    std::vector<bool> in_unit(count, false);
    for (const Unit& unit : file.units)
        std::fill(in_unit.begin() + unit.tokens.first, in_unit.begin() + unit.tokens.end, true);
    uint32_t first = 0;
    for (uint32_t i = 0; i < count && out.size() < kMostStatements; ++i) {
        const Token& token = lexed.tokens[i];
        const std::string_view word = lexed.view(token);
        if (in_unit[i] || (token.flags & (kInDirective | kDead | kOffStructure)) != 0 || word == "{" || word == "}") {
            first = i + 1;
            continue;
        }
        if (word != ";") continue;
        FileStatement one;
        one.tokens = {first, i + 1};
        first = i + 1;
        if (one.tokens.end - one.tokens.first < 3 || !branches_around(file, one.tokens.first).empty()) continue;
        name_statement(lexed, one);
        for (uint32_t k = one.tokens.first; k < one.tokens.end; ++k) {
            if (k == one.name_token) one.head_length = one.words.size();
            one.words.append(lexed.view(k)).append(" ");
        }
        out.push_back(std::move(one));
    }
    return out;
}

}  // namespace porttool
