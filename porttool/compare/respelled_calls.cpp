// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/respelled_calls.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
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

/// A text without scopes, and the scope of each word that is left.
struct Unscoped {
    Words words;
    std::vector<std::string> scopes;

    explicit Unscoped(const Words& text) {
        std::string scope;
        for (size_t i = 0; i < text.size(); ++i) {
            if (is_word_token(text[i]) && i + 2 < text.size() && text[i + 1] == "::" && is_word_token(text[i + 2])) {
                scope.append(text[i]) += "::";
                ++i;
                continue;
            }
            words.push_back(text[i]);
            scopes.push_back(std::exchange(scope, {}));
        }
    }
};

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

bool only_qualifies_names(const Words& before, const Words& now) {
    const Unscoped then(before), today(now);
    if (then.words != today.words) return false;
    std::map<std::string_view, std::string_view> scopes;  // today's, by name
    std::set<std::string_view> rescoped, mixed;
    for (size_t i = 0; i < then.words.size(); ++i) {
        const std::pair<std::string_view, std::string_view> both{then.scopes[i], today.scopes[i]};
        if (both.first != both.second && !both.first.empty() && !both.second.empty()) return false;
        const std::string_view name = today.words[i];
        if (both.first != both.second) rescoped.insert(name);
        if (is_word_token(name) && scopes.emplace(name, both.second).first->second != both.second) mixed.insert(name);
    }
    return !rescoped.empty() &&
           std::none_of(rescoped.begin(), rescoped.end(), [&](std::string_view name) { return mixed.contains(name); });
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
