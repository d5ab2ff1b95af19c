// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/side_text.h"

#include <algorithm>

#include "porttool/difftest/old_style.h"
#include "porttool/difftest/prelude.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

bool is_assignment_sign(std::string_view sign) {
    return sign == "++" || sign == "--" ||
           (!sign.empty() && sign.back() == '=' && sign != "==" && sign != "!=" && sign != "<=" && sign != ">=");
}

/// Behind a name and what is asked of it: `x.y[3]`.
uint32_t behind_parts(const LexedText& lexed, uint32_t i, uint32_t end) {
    for (++i; i < end;) {
        const std::string_view word = lexed.view(i);
        if (word == "." || word == "->") {
            i += 2;
        } else if (word == "[") {
            int depth = 0;
            for (; i < end; ++i) {
                if (lexed.view(i) == "[") ++depth;
                if (lexed.view(i) == "]" && --depth == 0) break;
            }
            ++i;
        } else {
            break;
        }
    }
    return i;
}

/// The name of the call whose list of arguments stands around a place; "" for none.
std::string_view callee_around(const LexedText& lexed, uint32_t first, uint32_t i) {
    int depth = 0;
    while (i > first + 1) {
        const std::string_view word = lexed.view(--i);
        if (word == ";" || word == "{" || word == "}") return {};
        if (word == ")") ++depth;
        if (word == "(" && depth-- == 0)
            return lexed.tokens[i - 1].kind == TokenKind::Identifier ? lexed.view(i - 1) : std::string_view();
    }
    return {};
}

/// True where a call cannot write to what it is given: of something built in, or of functions that take values alone.
bool keeps_arguments(const Closure& closure, std::string_view callee) {
    if (callee.empty() || is_one_of(callee, {"if", "while", "for", "switch", "return"})) return true;
    bool known = false;
    for (const Piece& piece : closure.pieces) {
        const Definition& one = *piece.definition;
        if (one.name != callee) continue;
        if (one.kind != Definition::Kind::Function || one.unit == nullptr) return false;
        if (is_old_style(one.file->lexed, *one.unit) || has_two_heads(one.file->lexed, *one.unit)) return false;
        known = true;
        for (uint32_t i = one.unit->parameters.first; i < one.unit->parameters.end; ++i)
            if (is_one_of(one.file->lexed.view(i), {"*", "&", "[", "out", "inout"})) return false;
    }
    return known || (prelude_names().contains(callee) && !callee.starts_with("sincos") &&
                     !is_one_of(callee, {"modf", "frexp", "fract"}));
}

/// True where a function may write to what it calls `name`: by an assignment, or in a call that may.
bool may_write(const Definition& function, const Closure& closure, std::string_view name) {
    const LexedText& lexed = function.file->lexed;
    const TokenRange body = function.unit->body;
    for (uint32_t i = body.first; i < body.end; ++i) {
        if (lexed.view(i) != name || lexed.view(i - 1) == "." || lexed.view(i - 1) == "->") continue;
        const std::string_view before = lexed.view(i - 1);
        if (before == "++" || before == "--" || before == "&") return true;
        const uint32_t next = behind_parts(lexed, i, body.end);
        if (is_assignment_sign(lexed.view(next)) || lexed.view(next) == "(") return true;
        const std::string_view callee = callee_around(lexed, body.first, i);
        if (!keeps_arguments(closure, callee)) return true;
    }
    return false;
}

/// A field stands in its struct once; what a struct says twice one of its functions looks at.
void add_words_of_struct(const Definition& one, std::set<std::string, std::less<>>& out) {
    std::map<std::string_view, int> seen;
    const LexedText& lexed = one.file->lexed;
    for (uint32_t i = one.tokens.first; i < one.tokens.end; ++i)
        if (lexed.tokens[i].kind == TokenKind::Identifier && ++seen[lexed.view(i)] == 2)
            out.insert(std::string(lexed.view(i)));
}

}  // namespace

std::set<std::string, std::less<>> words_of_side(const Closure& closure) {
    std::set<std::string, std::less<>> out = closure.words;
    for (const Piece& piece : closure.pieces)
        if (piece.definition->kind == Definition::Kind::Struct)
            add_words_of_struct(*piece.definition, out);
        else
            out.insert(piece.words.begin(), piece.words.end());
    return out;
}

bool may_write_to_variable(const Subject& subject, std::string_view name) {
    if (may_write(*subject.function, subject.closure, name)) return true;
    return std::any_of(subject.closure.pieces.begin(), subject.closure.pieces.end(), [&](const Piece& piece) {
        const Definition& one = *piece.definition;
        return one.kind == Definition::Kind::Function && one.unit != nullptr && piece.words.contains(name) &&
               may_write(one, subject.closure, name);
    });
}

TextOfSide text_of_side(const Subject& subject) {
    TextOfSide out;
    out.words = words_of_side(subject.closure);
    for (size_t i = 0; i < subject.parameters.size(); ++i)
        if (!may_write(*subject.function, subject.closure, subject.parameters[i].name))
            out.unwritten.insert(static_cast<int>(i));
    return out;
}

}  // namespace porttool
