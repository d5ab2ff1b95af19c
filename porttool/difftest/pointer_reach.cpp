// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/pointer_reach.h"

#include <algorithm>
#include <charconv>
#include <vector>

#include "porttool/difftest/parameters.h"

namespace porttool {
namespace {

constexpr int kDeepest = 4;  ///< calls that a pointer is followed through
constexpr int kMostElements = 64;

bool is_value(const LexedText& lexed, uint32_t i) {
    const Token& token = lexed.tokens[i];
    if (token.kind == TokenKind::Number) return true;
    if (token.kind == TokenKind::Identifier) return lexed.view(i) != "return";
    return lexed.view(i) == ")" || lexed.view(i) == "]";
}

int index_at(const LexedText& lexed, uint32_t open, uint32_t end) {
    if (open + 2 >= end || lexed.view(open + 2) != "]") return 0;
    const std::string_view word = lexed.view(open + 1);
    int index = 0;
    const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc() || index < 0 || index >= kMostElements) return 0;
    return index + 1;
}

}  // namespace

int PointerReach::of(const Definition& function, std::string_view name, int depth) {
    if (depth > kDeepest || function.unit == nullptr) return 0;
    if (const auto [known, is_new] = seen_.try_emplace({&function, std::string(name)}, 1); !is_new)
        return known->second;
    return seen_[{&function, std::string(name)}] = look(function, name, depth);
}

int PointerReach::look(const Definition& function, std::string_view name, int depth) {
    const LexedText& lexed = function.file->lexed;
    const TokenRange body = function.unit->body;
    int most = 1;
    for (uint32_t i = body.first; i < body.end; ++i) {
        if (lexed.view(i) != name || lexed.tokens[i].kind != TokenKind::Identifier) continue;
        const std::string_view before = lexed.view(i - 1), next = i + 1 < body.end ? lexed.view(i + 1) : "";
        if (before == "." || before == "->") continue;
        int here = 0;
        if (next == "->" || next == "==" || next == "!=" || before == "!")
            here = 1;
        else if (next == "[")
            here = index_at(lexed, i + 1, body.end);
        else if (before == "*" && !is_value(lexed, i - 2))
            here = 1;
        else if (before == "(" && lexed.view(i - 2) == "if" && next == ")")
            here = 1;
        else if ((before == "(" || before == ",") && (next == ")" || next == ","))
            here = through_call(function, i, depth);
        if (here == 0) return 0;
        most = std::max(most, here);
    }
    return most;
}

int PointerReach::through_call(const Definition& function, uint32_t at, int depth) {
    const LexedText& lexed = function.file->lexed;
    int nested = 0;
    size_t place = 0;
    uint32_t open = at;
    while (open > function.unit->body.first) {
        const std::string_view word = lexed.view(--open);
        if (word == ")" || word == "]") ++nested;
        if (word == "[" || (word == "(" && nested > 0))
            --nested;
        else if (word == "(")
            break;
        if (word == "," && nested == 0) ++place;
        if (word == ";" || word == "{" || word == "}") return 0;
    }
    if (open == 0 || lexed.tokens[open - 1].kind != TokenKind::Identifier) return 0;
    const std::string_view callee = lexed.view(open - 1);
    if (callee == "sincos" || callee == "sincosf" || callee == "__sincosf" || callee == "modf" || callee == "frexp")
        return 1;
    int most = 0;
    for (const Definition* found : definitions_.find(*function.file, callee)) {
        if (found->kind != Definition::Kind::Function || found == &function) continue;
        const std::vector<SubjectParameter> parameters = parameters_of(*found->file, *found->unit, {});
        if (place >= parameters.size()) continue;
        const int here = of(*found, parameters[place].name, depth + 1);
        if (here == 0) return 0;
        most = std::max(most, here);
    }
    return most;
}

}  // namespace porttool
