// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/old_style.h"

#include "porttool/difftest/argument_list.h"

namespace porttool {
namespace {

/// What stands between a function's list and its body.
TokenRange behind_list(const Unit& function) { return {function.parameters.end + 1, function.body.first - 1}; }

/// The name that a declarator gives: of `*x`, `x[3]` and `(*x)(int)`; its place, or `end` where it has none.
uint32_t name_in(const LexedText& lexed, TokenRange part) {
    uint32_t name = part.end;
    for (uint32_t i = part.first; i < part.end && lexed.view(i) != "[" && lexed.view(i) != ")"; ++i)
        if (lexed.tokens[i].kind == TokenKind::Identifier) name = i;
    return name;
}

/// Where the declarator begins in the first part of a statement, behind the type.
uint32_t start_of_declarator(const LexedText& lexed, TokenRange part, uint32_t name) {
    while (name > part.first && (lexed.view(name - 1) == "*" || lexed.view(name - 1) == "(")) --name;
    return name;
}

}  // namespace

bool is_old_style(const LexedText& lexed, const Unit& function) {
    if (function.body.empty() || function.parameters.first == 0 || function.parameters.empty()) return false;
    bool declares = false;
    const TokenRange behind = behind_list(function);
    for (uint32_t i = behind.first; i < behind.end; ++i) {
        // Of two heads, one of each style, the preprocessor takes one.
        if ((lexed.tokens[i].flags & kInDirective) != 0) return false;
        declares = declares || lexed.view(i) == ";";
    }
    return declares;
}

bool has_two_heads(const LexedText& lexed, const Unit& function) { return !newer_list(lexed, function).empty(); }

TokenRange newer_list(const LexedText& lexed, const Unit& function) {
    if (function.body.empty() || function.parameters.first == 0) return {};
    const TokenRange behind = behind_list(function);
    const std::string_view name = lexed.view(function.name_token);
    bool branches = false;
    TokenRange out;
    for (uint32_t i = behind.first; i + 1 < behind.end; ++i) {
        branches = branches || (lexed.tokens[i].flags & kInDirective) != 0;
        if (!branches || lexed.view(i) != name || lexed.view(i + 1) != "(") continue;
        uint32_t close = i + 1;
        for (int depth = 0; close < behind.end; ++close) {
            if (lexed.view(close) == "(") ++depth;
            if (lexed.view(close) == ")" && --depth == 0) break;
        }
        out = {i + 2, close};
    }
    // The first may be the newer one: then each of its parameters has a type.
    const auto has_types = [&](TokenRange list) {
        const std::vector<TokenRange> parts = list_parts(lexed, list);
        return !parts.empty() && parts.front().end > parts.front().first + 1;
    };
    return !out.empty() && has_types(function.parameters) && !has_types(out) ? function.parameters : out;
}

std::vector<OldStyleParameter> old_style_parameters(const LexedText& lexed, const Unit& function) {
    std::vector<OldStyleParameter> out;
    for (const TokenRange name : list_parts(lexed, function.parameters)) out.push_back({{}, name});
    const TokenRange behind = behind_list(function);
    for (uint32_t first = behind.first, i = behind.first; i < behind.end; ++i) {
        if (lexed.view(i) != ";") continue;
        TokenRange type;
        for (const TokenRange part : list_parts(lexed, {first, i})) {
            const uint32_t name = name_in(lexed, part);
            if (name == part.end) continue;
            const uint32_t start = part.first == first ? start_of_declarator(lexed, part, name) : part.first;
            if (part.first == first) type = {first, start};
            for (OldStyleParameter& one : out)
                if (lexed.view(one.name.end - 1) == lexed.view(name) && one.type.empty())
                    one = {type, {start, part.end}};
        }
        first = i + 1;
    }
    return out;
}

}  // namespace porttool
