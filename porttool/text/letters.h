// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Letters of ASCII, whatever the locale: names, suffixes and keywords have no others.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace porttool {

constexpr bool is_capital_letter(char c) { return c >= 'A' && c <= 'Z'; }
constexpr bool is_small_letter(char c) { return c >= 'a' && c <= 'z'; }
constexpr char small_letter(char c) { return is_capital_letter(c) ? static_cast<char>(c - 'A' + 'a') : c; }
constexpr char capital_letter(char c) { return is_small_letter(c) ? static_cast<char>(c - 'a' + 'A') : c; }

inline std::string in_small_letters(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), small_letter);
    return out;
}

/// True if the text is `small`, which is in small letters, whatever its own case.
inline bool is_in_any_case(std::string_view text, std::string_view small) {
    return std::equal(text.begin(), text.end(), small.begin(), small.end(),
                      [](char a, char b) { return small_letter(a) == b; });
}

/// True if the text holds `small`, which is in small letters, whatever its own case.
inline bool holds_in_any_case(std::string_view text, std::string_view small) {
    return std::search(text.begin(), text.end(), small.begin(), small.end(),
                       [](char a, char b) { return small_letter(a) == b; }) != text.end();
}

}  // namespace porttool
