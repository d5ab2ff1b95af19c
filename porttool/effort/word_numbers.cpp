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
    key_.assign(reinterpret_cast<const char*>(words.data()), words.size_bytes());
    return numbers_.try_emplace(key_, static_cast<uint32_t>(numbers_.size() + 1)).first->second;
}

uint32_t WordNumbers::word(std::string_view text, TokenKind kind) {
    const auto known = numbers_.find(text);
    if (known != numbers_.end() && words_[known->second].is_read) return known->second;
    const std::string spelled = kind == TokenKind::Number ? normal_number(text) : std::string(text);
    const uint32_t place = number(spelled, text);
    if (!words_[place].is_read) {
        const std::string common = common_word(spelled, dialect_);
        const uint32_t meaning = common.empty() ? kNone : common == spelled ? place : number(common, {});
        words_[place] = {meaning, mark_of(spelled), starts_name(spelled), true};
    }
    numbers_.try_emplace(text, place);
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

uint32_t WordNumbers::closing_brace() { return number("}", {}); }

WordNumbers::Mark WordNumbers::mark_of(std::string_view text) {
    if (text == "(") return Mark::OpenParen;
    if (text == ")") return Mark::CloseParen;
    if (text == ";") return Mark::Semicolon;
    if (text == "{") return Mark::OpenBrace;
    if (text == "}") return Mark::CloseBrace;
    return text == "::" ? Mark::Scope : Mark::None;
}

uint32_t WordNumbers::number(const std::string& text, std::string_view own) {
    if (const auto known = numbers_.find(text); known != numbers_.end()) return known->second;
    const std::string_view key = text == own ? own : kept_.emplace_back(text);
    words_.emplace_back();
    return numbers_.emplace(key, static_cast<uint32_t>(words_.size() - 1)).first->second;
}

}  // namespace porttool
