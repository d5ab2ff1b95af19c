// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/operands.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

/// How tight an operator of two operands binds; 0 for what ends an expression, -1 for what nobody knows.
int tightness(const std::string& word) {
    if (is_one_of(word, {"*", "/", "%"})) return 9;
    if (is_one_of(word, {"+", "-"})) return 8;
    if (is_one_of(word, {"<<", ">>"})) return 7;
    if (is_one_of(word, {"<", ">", "<=", ">="})) return 6;
    if (is_one_of(word, {"==", "!="})) return 5;
    if (word == "&") return 4;
    if (word == "^") return 3;
    if (word == "|") return 2;
    if (is_one_of(word, {"&&", "||"})) return 1;
    const bool ends =
        is_one_of(word, {"(", ")", "[", "]", "{", "}", ",", ";", "=", "+=", "-=", "*=", "/=", "return", "?", ":"});
    return ends ? 0 : -1;
}

bool opens_part(const std::string& word) { return is_one_of(word, {"(", "[", "{"}); }
bool closes_part(const std::string& word) { return is_one_of(word, {")", "]", "}"}); }
bool joins_names(const std::string& word) { return is_one_of(word, {".", "->", "::"}); }

/// Where the operand begins that ends before `end`; `end` where there is none.
size_t begin_of_operand(StatementWords words, const BracketPartners& partners, size_t end) {
    size_t at = end;
    while (at > 0) {
        const std::string& last = words[at - 1];
        if (closes_part(last)) {
            const size_t open = partners.of(at - 1);
            if (open == at - 1 || open == 0 || !(is_word_token(words[open - 1]) || closes_part(words[open - 1])))
                return end;
            at = open;
        } else if (is_word_token(last) || is_number_token(last)) {
            --at;
            if (at == 0 || !joins_names(words[at - 1])) return at;
            --at;
        } else {
            return end;
        }
    }
    return end;
}

size_t end_of_operand(StatementWords words, const BracketPartners& partners, size_t first) {
    if (first >= words.size() || !(is_word_token(words[first]) || is_number_token(words[first]))) return first;
    size_t at = first + 1;
    while (at < words.size()) {
        if (is_one_of(words[at], {"(", "["})) {
            const size_t close = partners.of(at);
            if (close == at) return first;
            at = close + 1;
        } else if (joins_names(words[at]) && at + 1 < words.size() && is_word_token(words[at + 1])) {
            at += 2;
        } else {
            return at;
        }
    }
    return at;
}

StatementWords words_between(StatementWords words, size_t first, size_t end) {
    return words.subspan(first, end - first);
}

}  // namespace

BracketPartners::BracketPartners(StatementWords words, bool with_braces) : partners_(words.size()) {
    std::vector<size_t> open;
    for (size_t i = 0; i < words.size(); ++i) {
        partners_[i] = i;
        if (!with_braces && is_one_of(words[i], {"{", "}"})) continue;
        if (opens_part(words[i])) {
            open.push_back(i);
        } else if (closes_part(words[i]) && !open.empty()) {
            partners_[i] = open.back();
            partners_[open.back()] = i;
            open.pop_back();
        }
    }
}

std::optional<TwoOperands> operands_at(StatementWords words, const BracketPartners& partners, size_t at) {
    const size_t first = begin_of_operand(words, partners, at), end = end_of_operand(words, partners, at + 1);
    if (first == at || end == at + 1) return std::nullopt;
    const int own = tightness(words[at]), before = first == 0 ? 0 : tightness(words[first - 1]),
              behind = end == words.size() ? 0 : tightness(words[end]);
    if (before < 0 || before >= own || behind < 0 || behind > own) return std::nullopt;
    if (first > 0 && closes_part(words[first - 1])) return std::nullopt;  // of a cast, or the head of a branch
    return TwoOperands{words_between(words, first, at), words_between(words, at + 1, end)};
}

std::optional<TwoOperands> branches_at(StatementWords words, size_t at) {
    size_t colon = 0, end = words.size();
    int depth = 0;
    for (size_t i = at + 1; i < words.size(); ++i) {
        if (words[i] == "?") return std::nullopt;  // one choice in another
        if (closes_part(words[i]) && depth == 0) {
            end = i;
            break;
        }
        depth += opens_part(words[i]) ? 1 : closes_part(words[i]) ? -1 : 0;
        if (depth != 0) continue;
        if (words[i] == ":" && colon == 0) {
            colon = i;
        } else if (is_one_of(words[i], {",", ";", ":"})) {
            end = i;
            break;
        }
    }
    if (colon == 0 || colon == at + 1 || end <= colon + 1) return std::nullopt;
    return TwoOperands{words_between(words, at + 1, colon), words_between(words, colon + 1, end)};
}

std::vector<StatementWords> parts_of(StatementWords words, const BracketPartners& partners, size_t open,
                                     const std::string& cut) {
    std::vector<StatementWords> out;
    const size_t close = partners.of(open);
    if (close == open) return {};
    size_t first = open + 1;
    for (size_t i = first; i <= close; ++i) {
        if (i < close && words[i] != cut) {
            if (opens_part(words[i])) i = partners.of(i);
            continue;
        }
        if (i == first) return {};
        out.push_back(words_between(words, first, i));
        first = i + 1;
    }
    return out;
}

bool are_same(StatementWords a, StatementWords b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); }

bool ShorterFirst::operator()(StatementWords a, StatementWords b) const {
    if (a.size() != b.size()) return a.size() < b.size();
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace porttool
