// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/assumed_macros.h"

#include <cstdint>

namespace porttool {
namespace {

/// What makes the comparison behind a macro hold: 3 for `== 3`, `>= 3` and `> 2`; 1 for none.
std::string value_before(const LexedText& lexed, uint32_t sign, uint32_t end) {
    if (sign + 1 >= end || lexed.tokens[sign + 1].kind != TokenKind::Number) return "1";
    const std::string_view word = lexed.view(sign), number = lexed.view(sign + 1);
    if (word == "==" || word == ">=") return std::string(number);
    return word == ">" ? "(" + std::string(number) + " + 1)" : "1";
}

/// True where what stands at `i` is asked not to be: `!X`, `!defined(X)`, `!defined X`.
bool is_denied(const LexedText& lexed, uint32_t i) {
    uint32_t before = i - 1;
    if (lexed.view(before) == "(" && lexed.view(before - 1) == "defined") --before;
    if (lexed.view(before) == "defined") --before;
    return lexed.view(before) == "!";
}

/// Those of the condition between two tokens: of several of which one is enough the first.
void add_asked(const Definition& one, const Definitions& definitions, TokenRange condition,
               std::map<std::string, std::string>& out) {
    const LexedText& lexed = one.file->lexed;
    for (uint32_t i = condition.first; i < condition.end; ++i) {
        const std::string_view word = lexed.view(i);
        if (word == "||") return;
        if (lexed.tokens[i].kind != TokenKind::Identifier || word == "defined" || word.starts_with("_")) continue;
        if (i + 1 < condition.end && lexed.view(i + 1) == "(") continue;
        if (is_denied(lexed, i) || !definitions.find_macro(*one.file, word).empty()) continue;
        out.emplace(word, value_before(lexed, i + 1, condition.end));
    }
}

}  // namespace

std::map<std::string, std::string> assumed_macros(const Definition& one, const Definitions& definitions) {
    std::map<std::string, std::string> out;
    const LexedText& lexed = one.file->lexed;
    size_t group = 0;
    for (size_t i = 0; i < one.conditions.size(); ++i) {
        const Directive& line = lexed.directives[one.conditions[i]];
        if (line.kind == DirectiveKind::If) group = i;
        // It stands behind the last of a group's lines.
        if (i + 1 < one.conditions.size() && lexed.directives[one.conditions[i + 1]].kind != DirectiveKind::If)
            continue;
        const Directive& first = lexed.directives[one.conditions[group]];
        const bool denies = lexed.view(first.first_token + 1) == "ifndef";
        if (line.kind != DirectiveKind::Else && (i != group || !denies))
            add_asked(one, definitions, {line.first_token + 2, line.end_token}, out);
        if (line.kind == DirectiveKind::Else && i == group + 1 && denies)
            add_asked(one, definitions, {first.first_token + 2, first.end_token}, out);
    }
    return out;
}

std::map<std::string, std::string> assumed_for(std::string_view name, const Closure& closure,
                                               const Definitions& definitions) {
    std::map<std::string, std::string> out;
    for (const Piece& piece : closure.pieces)
        if (piece.definition->name == name) out.merge(assumed_macros(*piece.definition, definitions));
    return out;
}

}  // namespace porttool
