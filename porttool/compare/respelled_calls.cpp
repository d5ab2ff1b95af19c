// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/respelled_calls.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace porttool {
namespace {

std::string letters_of(std::string_view name) {
    std::string out;
    for (const char c : name)
        if (c != '_') out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

constexpr size_t kLeast = 3;  // letters: `n(x)` and `N(x)` are two

/// Tokens without `std ::`.
Words without_std(const Words& tokens) {
    Words out;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i] == "std" && i + 1 < tokens.size() && tokens[i + 1] == "::")
            ++i;
        else
            out.push_back(tokens[i]);
    }
    return out;
}

bool is_called(const Words& tokens, size_t i) {
    return is_word_token(tokens[i]) && i + 1 < tokens.size() && tokens[i + 1] == "(";
}

}  // namespace

std::optional<std::vector<RespelledCall>> only_respelled_calls(const Words& before, const Words& now) {
    const Words then = without_std(before), today = without_std(now);
    if (then.size() != today.size()) return std::nullopt;
    std::vector<RespelledCall> out;
    for (size_t i = 0; i < then.size(); ++i) {
        if (then[i] == today[i]) continue;
        const std::string letters = letters_of(then[i]);
        if (!is_called(then, i) || !is_called(today, i) || letters.size() < kLeast || letters != letters_of(today[i]))
            return std::nullopt;
        out.push_back({then[i], today[i]});
    }
    return out;
}

std::string_view respelled_call(const NormalText& text, std::string_view name) {
    const std::string letters = letters_of(name);
    if (letters.size() < kLeast) return {};
    for (size_t i = 0; i + 1 < text.size(); ++i)
        if (text[i + 1] == "(" && is_word_token(text[i]) && text[i] != name && letters_of(text[i]) == letters)
            return text[i];
    return {};
}

}  // namespace porttool
