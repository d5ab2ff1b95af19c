// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/effort/word_numbers.h"

#include "porttool/normal/normal_form.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

bool starts_name(std::string_view text) {
    const char c = text.empty() ? '\0' : text[0];
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

}  // namespace

uint32_t SequenceNumbers::number(std::span<const uint32_t> words) {
    if (words.empty()) return 0;
    return numbers_.number({reinterpret_cast<const char*>(words.data()), words.size_bytes()}) + 1;
}

uint32_t WordNumbers::word(std::string_view text, TokenKind kind) {
    const uint32_t known = texts_.find(text);
    if (known != TextNumbers::kNone && words_[numbers_[known]].is_read) return numbers_[known];
    const std::string spelled = kind == TokenKind::Number ? normal_number(text) : std::string(text);
    const uint32_t place = number(spelled);
    if (!words_[place].is_read) {
        const std::string common = common_word(spelled, dialect_);
        const uint32_t meaning = common.empty() ? kNone : common == spelled ? place : number(common);
        words_[place] = {meaning, mark_of(spelled), starts_name(spelled), true};
    }
    if (texts_.number(text) == numbers_.size()) numbers_.push_back(place);
    return place;
}

void WordNumbers::append_common(std::span<const uint32_t> text, NumberedWords& out) const {
    int parens = 0;
    size_t statement = out.size();  // where it begins
    const Word* before = nullptr;   // within the statement
    for (const uint32_t number : text) {
        const Word& word = words_[number];
        if (word.mark == Mark::OpenParen) ++parens;
        if (word.mark == Mark::CloseParen) --parens;
        const bool is_brace = word.mark == Mark::OpenBrace || word.mark == Mark::CloseBrace;
        if (parens <= 0 && (word.mark == Mark::Semicolon || is_brace)) {
            if (word.mark == Mark::CloseBrace) out.push_back(word.common);
            statement = out.size();
            before = nullptr;
            continue;
        }
        if (word.mark == Mark::Scope) {  // scopes come and go: a::b is b
            if (before != nullptr && before->is_name && out.size() > statement && out.back() == before->common)
                out.pop_back();
        } else if (word.common != kNone) {
            out.push_back(word.common);
        }
        before = &word;
    }
}

uint32_t WordNumbers::closing_brace() { return number("}"); }

WordNumbers::Mark WordNumbers::mark_of(std::string_view text) {
    if (text == "(") return Mark::OpenParen;
    if (text == ")") return Mark::CloseParen;
    if (text == ";") return Mark::Semicolon;
    if (text == "{") return Mark::OpenBrace;
    if (text == "}") return Mark::CloseBrace;
    return text == "::" ? Mark::Scope : Mark::None;
}

uint32_t WordNumbers::number(std::string_view text) {
    const uint32_t place = texts_.number(text);
    if (place == numbers_.size()) {
        numbers_.push_back(static_cast<uint32_t>(words_.size()));
        words_.emplace_back();
    }
    return numbers_[place];
}

}  // namespace porttool
