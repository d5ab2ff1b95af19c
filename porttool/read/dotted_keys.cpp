// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/dotted_keys.h"

#include <algorithm>
#include <string>

namespace porttool {
namespace {

/// Behind the string that opens at `open`; the end of the text if it does not close.
size_t behind_string(std::string_view text, size_t open) {
    const char quote = text[open];
    const bool long_one = text.substr(open).starts_with(std::string(3, quote));
    const std::string close(long_one ? 3 : 1, quote);
    for (size_t i = open + close.size(); i < text.size(); ++i) {
        if (text[i] == '\\' && quote == '"') {
            ++i;
            continue;
        }
        if (!long_one && text[i] == '\n') return i;
        if (text.substr(i, close.size()) == close) return i + close.size();
    }
    return text.size();
}

}  // namespace

std::optional<uint32_t> line_of_deep_key(std::string_view text) {
    constexpr int kMostDots = 16;
    uint32_t line = 1;
    int dots = 0;
    for (size_t i = 0; i < text.size();) {
        const char c = text[i];
        if (c == '"' || c == '\'') {
            const size_t end = behind_string(text, i);
            for (; i < end; ++i) line += text[i] == '\n' ? 1 : 0;
            continue;
        }
        if (c == '#') {
            i = std::min(text.find('\n', i), text.size());
            continue;
        }
        if (c == '.' && ++dots > kMostDots) return line;
        if (c == '\n' || c == ',' || c == '=' || c == '{' || c == '}' || c == '[' || c == ']') dots = 0;
        line += c == '\n' ? 1 : 0;
        ++i;
    }
    return std::nullopt;
}

}  // namespace porttool
