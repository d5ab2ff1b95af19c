// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/bracketed_tokens.h"

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"

namespace porttool {

BracketedTokens::BracketedTokens(const LexedText& lexed, TokenRange range) : lexed_(lexed) {
    for (uint32_t i = range.first; i < range.end; ++i)
        if ((lexed.tokens[i].flags & (kInDirective | kDead)) == 0) tokens_.push_back(i);
    after_.assign(tokens_.size(), tokens_.size());
    std::vector<size_t> open;
    for (size_t i = 0; i < tokens_.size(); ++i) {
        const std::string_view text = word(i);
        const char sign = text.size() == 1 ? text[0] : '\0';
        if (sign == '(' || sign == '[' || sign == '{') open.push_back(i);
        if (open.empty() || (sign != ')' && sign != ']' && sign != '}')) continue;
        after_[open.back()] = i + 1;
        open.pop_back();
    }
}

bool BracketedTokens::may_be_declared(size_t i) const {
    const std::string_view text = word(i);
    const bool type = is_type_word(text) && text != "half";  // half of something, where there is no such type
    return is_name(i) && !type && !word_is(text, kNoType | kQualifier | kRecord);
}

size_t BracketedTokens::after_arguments(size_t i) const {
    constexpr size_t kLongest = 64;
    int depth = 0;
    for (size_t at = i; at < tokens_.size() && at < i + kLongest; ++at) {
        const std::string_view text = word(at);
        if (text == "<") ++depth;
        if (text == ">") --depth;
        if (text == ">>") depth -= 2;
        if (depth <= 0) return depth == 0 ? at + 1 : i;
        const bool fits = is_name(at) || is_a(at, TokenKind::Number) ||
                          is_one_of(text, {"<", ">", ">>", ",", "::", "*", "&", "...", "[", "]", "(", ")"});
        if (!fits || word_is(text, kNoType)) return i;
    }
    return i;
}

}  // namespace porttool
