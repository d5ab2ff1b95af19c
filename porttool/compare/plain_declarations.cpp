// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/plain_declarations.h"

#include <algorithm>
#include <optional>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/directive_end.h"

namespace porttool {
namespace {

/// A stretch of tokens.
struct WordSpan {
    size_t first = 0, end = 0;
};

/// `const float a = 1 , b`: the type's words, and each variable with what it is given.
struct NumberDeclaration {
    WordSpan type;
    std::vector<WordSpan> variables;
    bool is_const = false;
};

/// Where the statements end that begin at each token: at a semicolon outside of their brackets, or with the text where
/// there is none, or a bracket closes that they did not open. Looked through once, when it is first asked.
class StatementEnds {
public:
    explicit StatementEnds(const Words& tokens) : tokens_(tokens) {}

    size_t of(size_t first) {
        if (ends_.empty()) fill();
        return ends_[first];
    }

private:
    void fill() {
        const size_t none = tokens_.size();
        ends_.assign(none + 1, none);
        std::vector<size_t> after;  ///< where what begins behind each bracket that is open ends, from the text's end
        for (size_t i = none; i-- > 0;) {
            const char sign = tokens_[i].size() == 1 ? tokens_[i].front() : ' ';
            if (sign == ')' || sign == ']' || sign == '}') {
                after.push_back(ends_[i + 1]);
            } else if (sign == '(' || sign == '[' || sign == '{') {
                if (after.empty()) continue;
                ends_[i] = after.back();
                after.pop_back();
            } else {
                ends_[i] = sign == ';' ? i : ends_[i + 1];
            }
        }
    }

    const Words& tokens_;
    std::vector<size_t> ends_;
};

/// True for `a`, `a = ...` and `a [ 4 ] = ...`.
bool is_variable(const Words& tokens, WordSpan range) {
    if (range.first >= range.end || !is_word_token(tokens[range.first])) return false;
    size_t i = range.first + 1;
    while (i < range.end && tokens[i] == "[") {
        while (i < range.end && tokens[i] != "]") ++i;
        ++i;
    }
    return i >= range.end || (tokens[i] == "=" && i + 1 < range.end);
}

std::optional<NumberDeclaration> declaration_at(const Words& tokens, WordSpan statement) {
    NumberDeclaration out;
    size_t i = statement.first;
    out.is_const = tokens[i] == "const";
    i += out.is_const ? 1 : 0;
    const size_t type = i;
    while (i < statement.end && is_type_word(tokens[i])) ++i;
    if (i == type) return std::nullopt;
    out.type = {statement.first, i};
    int depth = 0;
    size_t first = i;
    for (; i <= statement.end; ++i) {
        const std::string_view word = i < statement.end ? tokens[i] : ",";
        if (is_one_of(word, {"(", "[", "{"})) ++depth;
        if (is_one_of(word, {")", "]", "}"})) --depth;
        if (word == "<" || word == ">") return std::nullopt;  // brackets, it may be
        if (depth != 0 || word != ",") continue;
        if (!is_variable(tokens, {first, i})) return std::nullopt;
        out.variables.push_back({first, i});
        first = i + 1;
    }
    return out;
}

/// The end of `a = ... ;` after the declaration of `a`, if that is all of the statement and reads no `a`; else 0.
size_t end_of_first_value(const Words& tokens, size_t first, std::string_view name, StatementEnds& ends) {
    if (first + 2 >= tokens.size() || tokens[first] != name || tokens[first + 1] != "=") return 0;
    const size_t end = ends.of(first);
    int depth = 0;
    for (size_t i = first + 2; i < end; ++i) {
        depth += is_one_of(tokens[i], {"(", "[", "{"}) ? 1 : is_one_of(tokens[i], {")", "]", "}"}) ? -1 : 0;
        if (tokens[i] == name || (depth == 0 && is_one_of(tokens[i], {",", "="}))) return 0;
    }
    return end == tokens.size() || end == first + 2 ? 0 : end;
}

void append(Words& out, const Words& tokens, WordSpan range) {
    out.insert(out.end(), tokens.begin() + static_cast<std::ptrdiff_t>(range.first),
               tokens.begin() + static_cast<std::ptrdiff_t>(range.end));
}

}  // namespace

Words with_plain_declarations(const Words& tokens) {
    Words out;
    StatementEnds ends(tokens);
    int parentheses = 0;
    size_t behind_directive = 0;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i] == "#") behind_directive = directive_end(tokens, i);
        parentheses += tokens[i] == "(" ? 1 : tokens[i] == ")" ? -1 : 0;
        const bool starts =
            parentheses == 0 && i > 0 && (is_one_of(tokens[i - 1], {";", "{", "}"}) || i == behind_directive);
        const bool may_be = starts && (tokens[i] == "const" || is_type_word(tokens[i]));
        const size_t end = may_be ? ends.of(i) : tokens.size();
        const auto found = end < tokens.size() ? declaration_at(tokens, {i, end}) : std::nullopt;
        if (!found) {
            out.push_back(tokens[i]);
            continue;
        }
        for (const WordSpan& variable : found->variables) {
            append(out, tokens, found->type);
            append(out, tokens, variable);
            out.emplace_back(";");
        }
        i = end;
        const WordSpan last = found->variables.back();
        const bool is_bare = last.end == last.first + 1 && !found->is_const;
        const size_t given = is_bare ? end_of_first_value(tokens, i + 1, tokens[last.first], ends) : 0;
        if (given == 0) continue;
        out.pop_back();
        append(out, tokens, {i + 2, given + 1});
        i = given;
    }
    return out;
}

}  // namespace porttool
