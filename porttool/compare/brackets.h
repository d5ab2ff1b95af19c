// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/normal/normal_text.h"
#include "porttool/text/is_one_of.h"

namespace porttool {

/// After the parenthesis that closes the one at `open`; the end if none does.
inline size_t after_parentheses(const Words& words, size_t open) {
    int depth = 0;
    for (size_t i = open; i < words.size(); ++i) {
        if (words[i] == "(") ++depth;
        if (words[i] == ")" && --depth == 0) return i + 1;
    }
    return words.size();
}

/// How much deeper a word leads into brackets: 1, -1, or 0 for all but brackets.
inline int deeper(std::string_view word) {
    return is_one_of(word, {"(", "[", "{"}) ? 1 : is_one_of(word, {")", "]", "}"}) ? -1 : 0;
}

/// The words [first, end) of each argument of a call, and the place behind its brackets.
struct CallArguments {
    std::vector<std::pair<size_t, size_t>> given;
    size_t end = 0;
};

/// Those of the call whose bracket is at `open`; none if it does not close soon.
template <class Text>
CallArguments call_arguments(const Text& words, size_t open) {
    constexpr size_t kLongest = 256;
    CallArguments out;
    int depth = 0;
    size_t first = open + 1;
    for (size_t i = open; i < std::min(words.size(), open + kLongest); ++i) {
        depth += deeper(words[i]);
        if (depth > 1 || (depth == 1 && words[i] != ",")) continue;
        out.given.emplace_back(first, i);
        first = i + 1;
        if (depth == 0) {
            out.end = i + 1;
            return out;
        }
    }
    return {};
}

}  // namespace porttool
