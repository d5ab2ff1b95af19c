// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/name_words.h"

#include "porttool/text/letters.h"

namespace porttool {
namespace {

constexpr bool is_in_a_word(char c) { return is_capital_letter(c) || is_small_letter(c) || (c >= '0' && c <= '9'); }

}  // namespace

std::vector<std::string_view> name_pieces(std::string_view name) {
    std::vector<std::string_view> out;
    const auto is_small = [&](size_t i) { return i < name.size() && is_small_letter(name[i]); };
    size_t first = 0;
    for (size_t i = 1; i <= name.size(); ++i) {
        const bool goes_on = i < name.size() && is_in_a_word(name[i - 1]) && is_in_a_word(name[i]);
        if (goes_on && !(is_capital_letter(name[i]) && (is_small(i - 1) || is_small(i + 1)))) continue;
        out.push_back(name.substr(first, i - first));
        first = i;
    }
    return out;
}

std::vector<std::string> words_of_name(std::string_view name) {
    std::vector<std::string> out;
    for (const std::string_view piece : name_pieces(name))
        if (is_in_a_word(piece.front())) out.push_back(in_small_letters(piece));
    return out;
}

}  // namespace porttool
