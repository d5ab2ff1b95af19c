// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/respelled_calls.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/text/letters.h"

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

/// True for a scope that only says where a runtime keeps a name until it is settled: `sycl::ext::oneapi::plus` is
/// `sycl::plus`.
bool is_storey_of_runtime(std::string_view scope) {
    constexpr std::array<std::string_view, 6> kStoreys = {"cl", "sycl", "ext", "oneapi", "intel", "experimental"};
    return std::find(kStoreys.begin(), kStoreys.end(), scope) != kStoreys.end();
}

/// A text without scopes, and the scope of each word that is left.
struct Unscoped {
    Words words;
    std::vector<std::string> scopes;
    std::vector<std::string> settled;  ///< the scopes without storeys of a runtime

    explicit Unscoped(const Words& text) {
        std::string scope, without_storeys;
        for (size_t i = 0; i < text.size(); ++i) {
            if (is_word_token(text[i]) && i + 2 < text.size() && text[i + 1] == "::" && is_word_token(text[i + 2])) {
                scope.append(text[i]) += "::";
                if (!is_storey_of_runtime(text[i])) without_storeys.append(text[i]) += "::";
                ++i;
                continue;
            }
            words.push_back(text[i]);
            scopes.push_back(std::exchange(scope, {}));
            settled.push_back(std::exchange(without_storeys, {}));
        }
    }
};

/// `CUB_MAX` and `max`: a macro of a library for what every language has.
bool is_macro_for(std::string_view macro, std::string_view name) {
    constexpr std::array<std::string_view, 3> kEverywhere = {"max", "min", "abs"};
    const size_t last = macro.rfind('_');
    const bool is_capital = std::none_of(macro.begin(), macro.end(), is_small_letter);
    return last != std::string_view::npos && is_capital && is_in_any_case(macro.substr(last + 1), name) &&
           std::find(kEverywhere.begin(), kEverywhere.end(), name) != kEverywhere.end();
}

}  // namespace

std::optional<std::vector<RespelledCall>> only_respelled_calls(const Words& before, const Words& now) {
    const Words then = without_std(before), today = without_std(now);
    if (then.size() != today.size()) return std::nullopt;
    std::vector<RespelledCall> out;
    for (size_t i = 0; i < then.size(); ++i) {
        if (then[i] == today[i]) continue;
        const std::string letters = letters_of(then[i]);
        const bool is_same = letters.size() >= kLeast && letters == letters_of(today[i]);
        const bool is_macro = is_macro_for(then[i], today[i]) || is_macro_for(today[i], then[i]);
        if (!is_called(then, i) || !is_called(today, i) || !(is_same || is_macro)) return std::nullopt;
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
        const bool is_other_scope = both.first != both.second && !both.first.empty() && !both.second.empty();
        if (is_other_scope && then.settled[i] != today.settled[i]) return false;
        const std::string_view name = today.words[i];
        if (both.first != both.second) rescoped.insert(name);
        if (is_word_token(name) && scopes.emplace(name, both.second).first->second != both.second) mixed.insert(name);
    }
    return !rescoped.empty() &&
           std::none_of(rescoped.begin(), rescoped.end(), [&](std::string_view name) { return mixed.contains(name); });
}

bool only_respells_members(const Words& before, const Words& now) {
    if (before.size() != now.size()) return false;
    const auto picks = [](std::string_view word) { return word == "." || word == "->"; };
    bool any = false;
    for (size_t i = 0; i < now.size(); ++i) {
        if (before[i] == now[i]) continue;
        if (!picks(before[i]) || !picks(now[i]) || i + 1 >= now.size() || is_called(now, i + 1)) return false;
        any = true;
    }
    return any;
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
