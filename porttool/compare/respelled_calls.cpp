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

std::vector<std::string> with_plain_calls(const Words& tokens) {
    std::vector<std::string> out;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i] == "std" && i + 1 < tokens.size() && tokens[i + 1] == "::") {
            ++i;
            continue;
        }
        const bool called = is_word_token(tokens[i]) && i + 1 < tokens.size() && tokens[i + 1] == "(";
        std::string letters = called ? letters_of(tokens[i]) : std::string();
        out.push_back(letters.size() >= kLeast ? std::move(letters) : std::string(tokens[i]));
    }
    return out;
}

}  // namespace

bool only_respells_calls(const Words& before, const Words& now) {
    return with_plain_calls(before) == with_plain_calls(now);
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
