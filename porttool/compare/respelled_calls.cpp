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

constexpr size_t kLeastLetters = 3;  // letters: `n(x)` and `N(x)` are two

/// Tokens without `std ::`, and which of them stood behind it.
struct WithoutStd {
    Words words;
    std::vector<bool> is_of_std;

    explicit WithoutStd(const Words& tokens) {
        bool of_std = false;
        for (size_t i = 0; i < tokens.size(); ++i) {
            if (tokens[i] == "std" && i + 1 < tokens.size() && tokens[i + 1] == "::") {
                of_std = true;
                ++i;
                continue;
            }
            words.push_back(tokens[i]);
            is_of_std.push_back(std::exchange(of_std, false));
        }
    }
};

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

/// `CUB_MAX` and `max`: what may be a macro of a library for what every language has.
bool is_macro_for(std::string_view macro, std::string_view name) {
    constexpr std::array<std::string_view, 3> kEverywhere = {"max", "min", "abs"};
    const size_t last = macro.rfind('_');
    const bool is_capital = std::none_of(macro.begin(), macro.end(), is_small_letter);
    return last != std::string_view::npos && is_capital && is_in_any_case(macro.substr(last + 1), name) &&
           std::find(kEverywhere.begin(), kEverywhere.end(), name) != kEverywhere.end();
}

}  // namespace

std::optional<std::vector<RespelledCall>> only_respelled_calls(const Words& before, const Words& now) {
    const WithoutStd with_places_then(before), with_places_today(now);
    const Words &then = with_places_then.words, &today = with_places_today.words;
    if (then.size() != today.size()) return std::nullopt;
    std::vector<RespelledCall> out;
    for (size_t i = 0; i < then.size(); ++i) {
        if (then[i] == today[i]) {
            if (with_places_then.is_of_std[i] != with_places_today.is_of_std[i]) out.push_back({then[i], today[i]});
            continue;
        }
        const std::string letters = letters_of(then[i]);
        const bool is_same = letters.size() >= kLeastLetters && letters == letters_of(today[i]);
        const bool is_macro = is_macro_for(then[i], today[i]) || is_macro_for(today[i], then[i]);
        if (!is_called(then, i) || !is_called(today, i) || !(is_same || is_macro)) return std::nullopt;
        out.push_back({then[i], today[i], !is_same});
    }
    return out;
}

std::optional<std::vector<RescopedName>> only_qualified_names(const Words& before, const Words& now) {
    const Unscoped then(before), today(now);
    if (then.words != today.words) return std::nullopt;
    std::map<std::string_view, std::string_view> scopes;  // today's, by name
    std::map<std::string_view, std::string> rescoped;     // the scope that came or went, by name
    std::set<std::string_view> mixed;
    for (size_t i = 0; i < then.words.size(); ++i) {
        const std::string &was = then.scopes[i], &is = today.scopes[i];
        const std::string_view name = today.words[i];
        if (was != is && !was.empty() && !is.empty() && then.settled[i] != today.settled[i]) return std::nullopt;
        if (was != is) {
            const std::string& left_out = was.empty() ? is : is.empty() ? was : std::string();
            const auto [known, is_new] = rescoped.emplace(name, left_out);
            if (!is_new && known->second != left_out) mixed.insert(name);
        }
        if (is_word_token(name) && scopes.emplace(name, is).first->second != is) mixed.insert(name);
    }
    std::vector<RescopedName> out;
    for (auto& [name, scope] : rescoped) {
        if (mixed.contains(name)) return std::nullopt;
        out.push_back({name, std::move(scope)});
    }
    if (out.empty()) return std::nullopt;
    return out;
}

bool is_scope_of_library(std::string_view scope) {
    constexpr std::array<std::string_view, 4> kRoots = {"std", "sycl", "cl", "metal"};
    for (bool is_first = true; !scope.empty(); is_first = false) {
        const std::string_view part = scope.substr(0, scope.find("::"));
        const bool is_root = std::find(kRoots.begin(), kRoots.end(), part) != kRoots.end();
        if (!is_root && !is_storey_of_runtime(part)) return false;
        if (is_first && part == "experimental") return false;
        scope.remove_prefix(std::min(scope.size(), part.size() + 2));
    }
    return true;
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
    if (letters.size() < kLeastLetters) return {};
    for (size_t i = 0; i + 1 < text.size(); ++i)
        if (text[i + 1] == "(" && is_word_token(text[i]) && text[i] != name && letters_of(text[i]) == letters)
            return text[i];
    return {};
}

}  // namespace porttool
