// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/port_text.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

std::string_view blanks_before(const LexedText& text, size_t offset) {
    size_t first = offset;
    while (first > 0 && (text.text[first - 1] == ' ' || text.text[first - 1] == '\t')) --first;
    return std::string_view(text.text).substr(first, offset - first);
}

bool starts_line(const LexedText& text, size_t offset) {
    const size_t first = offset - blanks_before(text, offset).size();
    return first == 0 || text.text[first - 1] == '\n';
}

size_t line_end(const LexedText& text, size_t offset) {
    const size_t end = text.text.find('\n', offset);
    return end == std::string::npos ? text.text.size() : end;
}

size_t PortText::placed_before(size_t word) const {
    while (word > 0)
        if (!is_added(--word)) return word;
    return kNone;
}

size_t PortText::placed_from(size_t word) const {
    while (word < target_.words.size() && is_added(word)) ++word;
    return word < target_.words.size() ? word : kNone;
}

std::string PortText::source_gap(size_t word) const {
    const UnitWords& words = source_.words;
    if (word == 0 || word >= words.size() || words.is_added(word)) return {};
    size_t before = word;
    do --before;
    while (before > 0 && words.is_added(before));
    if (words.is_added(before)) return {};
    const LexedText& lexed = source_.file.lexed;
    const Token &a = lexed.tokens[words.tokens[before]], &b = lexed.tokens[words.tokens[word]];
    const size_t end = a.offset + a.length;
    return b.offset < end ? std::string() : lexed.text.substr(end, b.offset - end);
}

std::string PortText::gap(const std::vector<CarriedWord>& words, size_t i) const {
    const CarriedWord &word = words[i], &before = words[i - 1];
    if (brace_layout_ != 0 && opens_block(word)) return brace_layout_ > 0 ? "\n" : " ";
    if (word.from != CarriedWord::kNoSource && before.from != CarriedWord::kNoSource && word.from == before.from + 1) {
        if (source_.words.is_added(word.from) || source_.words.is_added(before.from))
            return stand_apart(before.text, word.text) ? " " : "";
        const std::string written = source_gap(word.from);
        if (written.find('\n') != std::string::npos) return "\n";
        if (is_bracketed(before.text, word.text)) return stands_apart_there(before.text, word.text) ? " " : "";
        return written.empty() ? (must_part(before.text, word.text) ? " " : "") : " ";
    }
    return stands_apart_there(before.text, word.text) ? " " : "";
}

bool PortText::is_bracketed(const std::string& before, const std::string& next) {
    const bool opens = before == "(" || before == "[", closes = next == ")" || next == "]" || next == ",";
    return opens || closes;
}

bool PortText::stands_apart_there(const std::string& a, const std::string& b) const {
    const auto is_like = [](const std::string& here, const std::string& there) {
        return here == there || (is_word_token(here) && is_word_token(there));
    };
    size_t tight = 0, apart = 0;
    for (size_t i = 1; i < target_.words.size(); ++i) {
        const std::string &first = target_.words.words[i - 1], &second = target_.words.words[i];
        if (is_added(i - 1) || is_added(i) || (first != a && second != b)) continue;
        if (is_like(a, first) && is_like(b, second)) ++(end_of(i - 1) == start_of(i) ? tight : apart);
    }
    if (must_part(a, b) || tight == apart) return stand_apart(a, b);
    return apart > tight;
}

bool PortText::must_part(const std::string& a, const std::string& b) {
    return (is_word_token(a) || is_number_token(a)) && (is_word_token(b) || is_number_token(b));
}

std::string PortText::said(const CarriedWord& word) const {
    if (word.text != "@") return word.text;
    for (size_t i = 0; i < target_.words.size(); ++i)
        if (target_.words.words[i] == "@" && !is_added(i)) return std::string(text().view(token(i)));
    return word.text;
}

std::string PortText::written(const std::vector<CarriedWord>& words, const std::string& indent) const {
    std::string out;
    for (size_t i = 0; i < words.size(); ++i) {
        if (is_unwritten_brace(words[i])) continue;
        if (i > 0) {
            const std::string between = gap(words, i);
            out += between == "\n" ? "\n" + indent + continuation(words, i) : between;
        }
        out += said(words[i]);
    }
    return out;
}

std::string PortText::continuation(const std::vector<CarriedWord>& words, size_t i) const {
    if (words[i].text == "#" || words[i].from == CarriedWord::kNoSource || opens_block(words[i])) return {};
    const LexedText& lexed = source_.file.lexed;
    const auto blanks_of_line = [&](size_t word) {
        const Token& token = lexed.tokens[source_.words.tokens[word]];
        size_t at = lexed.line_starts[token.line - 1], count = 0;
        for (; at < lexed.text.size() && (lexed.text[at] == ' ' || lexed.text[at] == '\t'); ++at)
            count += lexed.text[at] == '\t' ? 4 : 1;
        return count;
    };
    size_t first = i;
    while (first > 0 && words[first - 1].from != CarriedWord::kNoSource &&
           !source_.words.is_added(words[first - 1].from))
        --first;
    if (source_.words.is_added(words[first].from) || source_.words.is_added(words[i].from)) return unit_;
    const size_t base = blanks_of_line(words[first].from), here = blanks_of_line(words[i].from);
    if (here <= base) return {};
    return unit_ == "\t" ? std::string((here - base + 3) / 4, '\t') : std::string(here - base, ' ');
}

bool PortText::opens_block(const CarriedWord& word) const {
    return word.text == "{" && std::any_of(source_.clauses.begin(), source_.clauses.end(), [&](const Clause& clause) {
               return clause.opens && clause.end - 1 == word.from;
           });
}

bool PortText::is_unwritten_brace(const CarriedWord& word) const {
    if (word.from == CarriedWord::kNoSource || (word.text != "{" && word.text != "}")) return false;
    return braces_.source_hidden.contains(word.from) ||
           (source_.words.is_added(word.from) && !braces_.source_written.contains(word.from));
}

std::string PortText::indent_of_line(size_t word) const {
    if (word == kNone) return {};
    size_t at = start_of(word);
    while (at > 0 && text().text[at - 1] != '\n') --at;
    size_t end = at;
    while (end < text().text.size() && (text().text[end] == ' ' || text().text[end] == '\t')) ++end;
    return text().text.substr(at, end - at);
}

int PortText::brace_layout() const {
    int own = 0;
    for (const Clause& clause : target_.clauses)
        if (clause.opens && clause.inside != kNone && !is_added(clause.end - 1))
            own += starts_line(text(), start_of(clause.end - 1)) ? 1 : -1;
    return own > 0 ? 1 : own < 0 ? -1 : 0;
}

bool stand_apart(std::string_view word, std::string_view next) {
    const auto one_of = [](std::string_view text, std::initializer_list<std::string_view> list) {
        return std::find(list.begin(), list.end(), text) != list.end();
    };
    if (one_of(next, {")", "]", ",", ";", ".", "->", "::", "[", "++", "--"})) return false;
    if (one_of(word, {"(", "[", ".", "->", "::", "!", "~", "@"})) return false;
    if (next == "(") return !is_word_token(word) || word_is(word, kControls) || word == "return";
    if (next == "<" || word == "<" || next == ">") return true;
    return true;
}

}  // namespace porttool
