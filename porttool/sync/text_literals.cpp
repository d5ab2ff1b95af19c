// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/text_literals.h"

#include <algorithm>
#include <set>

#include "porttool/text/letters.h"

namespace porttool {
namespace {

/// What a literal shows of values, `%s` or `%8.2f`, in order, each by its letter.
std::string values_shown(std::string_view literal) {
    std::string out;
    for (size_t i = literal.find('%'); i != std::string_view::npos; i = literal.find('%', i + 1)) {
        const size_t end = literal.find_first_not_of("-+ #0123456789.*hlzjtL", i + 1);
        if (end == std::string_view::npos) break;
        if (literal[end] != '%') out += literal[end];
        i = end;
    }
    return out;
}

std::set<std::string> words_in(std::string_view literal) {
    const std::vector<std::string> words = small_words_of(literal);
    return {words.begin(), words.end()};
}

}  // namespace

std::vector<std::string> small_words_of(std::string_view text) {
    std::vector<std::string> out;
    bool goes_on = false;
    for (const char c : text) {
        const bool is_part = is_small_letter(c) || is_capital_letter(c) || (c >= '0' && c <= '9');
        if (is_part && !goes_on) out.emplace_back();
        if (is_part) out.back() += small_letter(c);
        goes_on = is_part;
    }
    return out;
}

bool may_replace_literal(const LiteralEdit& edit) {
    const auto is_text = [](const std::string& word) { return word.starts_with('"'); };
    if (!is_text(edit.was) || !is_text(edit.is) || !is_text(edit.there)) return false;
    const std::set<std::string> was = words_in(edit.was), is = words_in(edit.is), there = words_in(edit.there);
    const auto kept = static_cast<size_t>(
        std::count_if(was.begin(), was.end(), [&](const std::string& word) { return there.contains(word); }));
    const bool has_no_own = std::all_of(
        there.begin(), there.end(), [&](const std::string& word) { return was.contains(word) || is.contains(word); });
    return has_no_own && 4 * kept >= 3 * was.size() && values_shown(edit.was) == values_shown(edit.there);
}

}  // namespace porttool
