// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/operands.h"

#include "porttool/compare/brackets.h"
#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"

namespace porttool {
namespace {

bool opens_bracket(const std::string& word) { return word == "(" || word == "[" || word == "{"; }
bool closes_bracket(const std::string& word) { return word == ")" || word == "]" || word == "}"; }

}  // namespace

bool is_name(const std::string& word) { return is_word_token(word) && !is_type_word(word) && !word_is(word, kKeyword); }

bool is_accessor(const std::string& word) { return word == "." || word == "->" || word == "::"; }

bool goes_on(const std::string& word) { return is_accessor(word) || word == "[" || word == "("; }

bool is_path(const std::vector<std::string>& words, size_t first, size_t end) {
    if (end < first + 2 || (end - first) % 2 != 0) return false;
    for (size_t i = first; i < end; i += 2)
        if (!is_name(words[i]) || !is_accessor(words[i + 1])) return false;
    return true;
}

bool is_operand(const std::vector<std::string>& words, size_t first, size_t end) {
    int depth = 0;
    for (size_t i = first; i < end; ++i) {
        const bool closes = closes_bracket(words[i]);
        depth += opens_bracket(words[i]) ? 1 : closes ? -1 : 0;
        if (depth < 0) return false;
        if (depth > 0 || closes || is_accessor(words[i])) continue;
        if (!is_name(words[i]) && !is_number_token(words[i])) return false;
    }
    return first < end && depth == 0;
}

size_t closing_bracket(const std::vector<std::string>& words, size_t open, size_t end) {
    int depth = 0;
    for (size_t i = open; i < end; ++i) {
        depth += deeper(words[i]);
        if (depth == 0) return i;
    }
    return end;
}

Clause value_of(const std::vector<std::string>& words, Clause clause) {
    if (clause.size() > 0 && words[clause.end - 1] == ";") --clause.end;
    int depth = 0;
    for (size_t i = clause.first; i < clause.end; ++i) {
        depth += opens_bracket(words[i]) ? 1 : closes_bracket(words[i]) ? -1 : 0;
        if (depth == 0 && (words[i] == "=" || words[i] == "return")) clause.first = i + 1;
    }
    return clause;
}

std::optional<size_t> only_result(const AlignedText& text) {
    std::optional<size_t> out;
    for (size_t c = 0; c < text.clauses.size(); ++c) {
        if (text.words[text.clauses[c].first] != "return") continue;
        if (out) return std::nullopt;
        out = c;
    }
    return out;
}

}  // namespace porttool
