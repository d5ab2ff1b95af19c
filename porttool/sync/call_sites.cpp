// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/call_sites.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

constexpr uint32_t kNoToken = static_cast<uint32_t>(-1);
constexpr uint32_t kLongestCall = 2000;  ///< tokens that are looked through for the end of one

/// The parenthesis that opens the arguments after a name: after template arguments, or a kernel's launch.
uint32_t open_after(const LexedText& lexed, uint32_t name) {
    const auto size = static_cast<uint32_t>(lexed.tokens.size());
    uint32_t i = name + 1;
    if (i >= size) return kNoToken;
    if (lexed.view(i) == "(") return i;
    if (!lexed.view(i).starts_with("<")) return kNoToken;
    int depth = 0, round = 0;
    constexpr uint32_t kMost = 100;
    for (; i < std::min(size, name + kMost); ++i) {
        const std::string_view word = lexed.view(i);
        if (word == ";" || word == "{" || word == "}") return kNoToken;
        round += word == "(" ? 1 : word == ")" ? -1 : 0;
        if (round < 0) return kNoToken;
        if (round > 0) continue;
        for (const char c : word) depth += c == '<' ? 1 : c == '>' && word != "->" ? -1 : 0;
        if (depth <= 0) return i + 1 < size && lexed.view(i + 1) == "(" ? i + 1 : kNoToken;
    }
    return kNoToken;
}

/// The comma-separated parts of [first, end) and where they end; a kNoToken for `close` if the bracket does not close.
void read_arguments(const LexedText& lexed, uint32_t open, CallSite& out) {
    const auto size = static_cast<uint32_t>(lexed.tokens.size());
    int depth = 0;
    uint32_t first = open + 1;
    out.close = kNoToken;
    for (uint32_t i = open + 1; i < std::min(size, open + kLongestCall); ++i) {
        const std::string_view word = lexed.view(i);
        if (word == "(" || word == "[" || word == "{") ++depth;
        const bool ends = depth == 0 && (word == "," || word == ")");
        if (word == ")" || word == "]" || word == "}") --depth;
        if (!ends) continue;
        if (i > first || word == ",") out.arguments.push_back({first, i});
        first = i + 1;
        if (word == ")") {
            out.close = i;
            return;
        }
    }
}

bool stands_in_body(const ScannedFile& file, uint32_t token) {
    return std::any_of(file.units.begin(), file.units.end(), [&](const Unit& unit) {
        const bool runs = unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel;
        return runs && unit.body.first <= token && token < unit.body.end;
    });
}

}  // namespace

std::vector<CallSite> call_sites(const ScannedFile& file, std::string_view function, bool of_class) {
    const LexedText& lexed = file.lexed;
    std::vector<CallSite> out;
    for (uint32_t i = 1; i + 1 < lexed.tokens.size(); ++i) {
        const Token& token = lexed.tokens[i];
        if (token.length != function.size() || token.kind != TokenKind::Identifier || lexed.view(token) != function)
            continue;
        const std::string_view before = lexed.view(i - 1);
        if (!of_class && (before == "." || before == "->")) continue;
        if (before == "define") continue;
        const uint32_t open = open_after(lexed, i);
        if (open == kNoToken) continue;
        const bool defines =
            std::any_of(file.units.begin(), file.units.end(), [&](const Unit& unit) { return unit.name_token == i; });
        if (defines) continue;
        CallSite site;
        site.name = i;
        read_arguments(lexed, open, site);
        if (site.close == kNoToken) continue;
        const bool typed = (lexed.tokens[i - 1].kind == TokenKind::Identifier && !word_is(before, kControls) &&
                            before != "return" && before != "else") ||
                           before == "*" || before == "&" || before == ">";
        site.declares = typed && !stands_in_body(file, i);
        if (site.declares && site.arguments.size() == 1 && lexed.view(site.arguments[0].first) == "void" &&
            site.arguments[0].end == site.arguments[0].first + 1)
            site.arguments.clear();
        out.push_back(std::move(site));
    }
    return out;
}

std::vector<CallSite> calls_within(const ScannedFile& file, const Unit& unit) {
    const LexedText& lexed = file.lexed;
    std::vector<CallSite> out;
    for (uint32_t i = std::max(unit.body.first, 1u); i < unit.body.end; ++i) {
        const std::string_view before = lexed.view(i - 1);
        const bool picked = before == "." || before == "->" || before == "::";
        if (lexed.tokens[i].kind != TokenKind::Identifier || picked) continue;
        const uint32_t open = open_after(lexed, i);
        if (open == kNoToken) continue;
        CallSite site;
        site.name = i;
        read_arguments(lexed, open, site);
        if (site.close != kNoToken) out.push_back(std::move(site));
    }
    return out;
}

bool takes_value(std::string_view before) {
    return is_one_of(before, {"=", "+=", "-=", "*=", "/=", "+", "-", "/", "==", "!=", "<", "<=", ">="});
}

std::vector<TokenRange> parameters_of_head(const ScannedFile& file, const Unit& unit) {
    const LexedText& lexed = file.lexed;
    std::vector<TokenRange> out;
    int depth = 0;
    uint32_t first = unit.parameters.first;
    for (uint32_t i = first; i <= unit.parameters.end && i < lexed.tokens.size(); ++i) {
        const std::string_view word = lexed.view(i);
        const bool ends = i == unit.parameters.end || (depth == 0 && word == ",");
        depth += word == "(" || word == "<" || word == "[" || word == "{"   ? 1
                 : word == ")" || word == ">" || word == "]" || word == "}" ? -1
                 : word == ">>"                                             ? -2
                                                                            : 0;
        if (!ends) continue;
        if (i > first) out.push_back({first, i});
        first = i + 1;
    }
    if (out.size() == 1 && out[0].end == out[0].first + 1 && lexed.view(out[0].first) == "void") out.clear();
    return out;
}

const Unit* unit_around(const ScannedFile& file, uint32_t token) {
    const Unit* out = nullptr;
    for (const Unit& unit : file.units)
        if (unit.tokens.first <= token && token < unit.tokens.end &&
            (out == nullptr || unit.tokens.end - unit.tokens.first < out->tokens.end - out->tokens.first))
            out = &unit;
    return out;
}

}  // namespace porttool
