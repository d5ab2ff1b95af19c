// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/locals.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/normal/declarations.h"

namespace porttool {
namespace {

/// A word that may name a local: of any alphabet.
bool is_name(std::string_view text) {
    const char c = text.empty() ? '\0' : text[0];
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$' || static_cast<signed char>(c) < 0;
}

}  // namespace

size_t LocalNumbers::next(std::string_view text, uint32_t token) {
    const char sign = text.size() == 1 ? text[0] : '\0';
    const bool named = is_name(text);
    if (head_closes_) close(sign == '{');
    const size_t number = named && !member_ ? number_of(text, token) : 0;
    if (sign == '(') open(scoped_);
    if (sign == '{') open_block();
    head_closes_ = sign == ')';
    if (sign == '}') close(false);
    member_ = sign == '.' || (text.size() == 2 && (text == "->" || text == "::"));
    scoped_ = sign == ']' || (named && word_is(text, kOwnScope));  // after `]` a lambda's parameters
    return number;
}

size_t LocalNumbers::number_of(std::string_view text, uint32_t token) {
    if (std::binary_search(places_.begin(), places_.end(), token)) {
        const uint32_t name = names_.number(text);
        numbers_.resize(names_.size());
        shadowed_.push_back({name, numbers_[name]});
        return numbers_[name] = ++count_;
    }
    const uint32_t name = names_.find(text);
    return name == TextNumbers::kNone ? 0 : numbers_[name];
}

void LocalNumbers::enter() { scopes_.push_back(shadowed_.size()); }
void LocalNumbers::leave() {
    if (scopes_.empty()) return;
    for (; shadowed_.size() > scopes_.back(); shadowed_.pop_back())
        numbers_[shadowed_.back().name] = shadowed_.back().number;
    scopes_.pop_back();
}

void LocalNumbers::open(bool scoped) {
    brackets_.push_back({scoped, false});
    if (scoped) enter();
}
/// A block takes over the scope of the head before it.
void LocalNumbers::open_block() {
    brackets_.push_back({true, true});
    if (!pending_) enter();
    pending_ = false;
}
void LocalNumbers::close(bool block_follows) {
    if (brackets_.empty()) return;
    const Bracket bracket = brackets_.back();
    brackets_.pop_back();
    if (!bracket.scoped) return;
    if (!bracket.block && block_follows)
        pending_ = true;
    else
        leave();
}

namespace {

/// A text in normal form as the finder reads files; every token stands for itself.
LexedText as_lexed(const Words& words) {
    LexedText out;
    for (const std::string_view word : words) {
        Token token;
        token.offset = static_cast<uint32_t>(out.text.size());
        token.length = static_cast<uint32_t>(word.size());
        token.kind = is_name(word) ? TokenKind::Identifier : TokenKind::Punctuator;
        out.tokens.push_back(token);
        out.text += word;
    }
    return out;
}

uint32_t find_from(const Words& words, uint32_t at, std::string_view word) {
    while (at < words.size() && words[at] != word) ++at;
    return at;
}

}  // namespace

std::vector<size_t> local_numbers(const Words& words) {
    const auto count = static_cast<uint32_t>(words.size());
    const uint32_t open = find_from(words, find_from(words, 0, "@"), "(");
    if (find_from(words, 0, "#") < count || open >= count) return {};
    uint32_t close = open;
    for (int depth = 0; close < count; ++close) {
        if (words[close] == "(") ++depth;
        if (words[close] == ")" && --depth == 0) break;
    }
    const uint32_t body = find_from(words, close, "{");
    if (body >= count) return {};
    const LexedText lexed = as_lexed(words);
    LocalNumbers numbers(declaring_tokens(lexed, {open + 1, close}, {body + 1, count - 1}));
    std::vector<size_t> out;
    for (uint32_t i = 0; i < count; ++i) out.push_back(numbers.next(words[i], i));
    return out;
}

}  // namespace porttool
