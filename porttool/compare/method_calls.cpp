// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/method_calls.h"

#include <algorithm>
#include <cstddef>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

bool is_access(std::string_view word) { return word == "." || word == "->"; }

std::string small(std::string_view word) {
    std::string out(word);
    std::transform(out.begin(), out.end(), out.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return out;
}

constexpr size_t kFarthest = 64;  // words, of a value

/// Where the brackets open that close with the last of [0, end); `end` if they do not soon.
size_t opening_before(const Text& words, size_t end) {
    int depth = 0;
    for (size_t i = end; i > 0 && end - i < kFarthest; --i) {
        const std::string& word = words[i - 1];
        if (word == ")" || word == "]") ++depth;
        if ((word == "(" || word == "[") && --depth == 0) return i - 1;
    }
    return end;
}

/// Where the value begins that ends with the last of `words`: `a . b [ i ]`, `f ( x )`; their number if it is none.
size_t value_before(const Text& words) {
    size_t first = words.size();
    while (first > 0 && words.size() - first < kFarthest) {
        const size_t end = first;
        while (first > 0 && (words[first - 1] == ")" || words[first - 1] == "]")) {
            const size_t open = opening_before(words, first);
            if (open == first) return words.size();
            first = open;
        }
        const bool named = first > 0 && is_word_token(words[first - 1]) && words[first - 1] != "return";
        if (named) --first;
        if (first == end) return words.size();
        if (first == 0 || !(is_access(words[first - 1]) || words[first - 1] == "::")) return first;
        if (!named) return words.size();
        --first;
    }
    return words.size();
}

}  // namespace

void CalledFunctions::add(const Words& text) {
    for (size_t i = 0; i + 1 < text.size(); ++i) {
        if (text[i + 1] != "(" || !is_word_token(text[i]) || (i > 0 && is_access(text[i - 1]))) continue;
        const std::string name(text[i]), method = small(name);
        by_method_[method].insert(name);
        const size_t underscore = method.find('_');
        const bool of_type = underscore != std::string::npos && name[0] >= 'A' && name[0] <= 'Z';
        if (of_type) by_method_[method.substr(underscore + 1)].insert(name);
    }
}

std::string CalledFunctions::function_for(const std::string& name) const {
    const auto found = by_method_.find(small(name));
    return found == by_method_.end() || found->second.size() != 1 ? std::string() : *found->second.begin();
}

Text with_functions_for_methods(const Words& text, const CalledFunctions& there) {
    Text out;
    for (size_t i = 0; i < text.size(); ++i) {
        const bool method = is_access(text[i]) && i + 3 < text.size() && text[i + 2] == "(";
        const std::string function = method ? there.function_for(std::string(text[i + 1])) : std::string();
        const size_t first = function.empty() ? out.size() : value_before(out);
        if (first == out.size()) {
            out.emplace_back(text[i]);
            continue;
        }
        out.insert(out.begin() + static_cast<std::ptrdiff_t>(first), {function, "("});
        if (text[i + 3] != ")") out.emplace_back(",");
        i += 2;
    }
    return out;
}

}  // namespace porttool
