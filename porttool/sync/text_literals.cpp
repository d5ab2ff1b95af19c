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

bool is_part_of_word(char c) { return is_small_letter(c) || is_capital_letter(c) || (c >= '0' && c <= '9'); }

/// True if no word of a text goes over a place.
bool is_between_words(std::string_view text, size_t at) {
    return at == 0 || at >= text.size() || !is_part_of_word(text[at - 1]) || !is_part_of_word(text[at]);
}

/// Where a text has another one, if it does so once; npos else.
size_t only_place_in(std::string_view text, std::string_view part) {
    const size_t at = text.find(part);
    return at == std::string_view::npos || text.find(part, at + 1) != std::string_view::npos ? std::string_view::npos
                                                                                             : at;
}

}  // namespace

std::vector<std::string> small_words_of(std::string_view text) {
    std::vector<std::string> out;
    bool goes_on = false;
    for (const char c : text) {
        const bool is_part = is_part_of_word(c);
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

std::string literal_changed_alike(const LiteralEdit& edit) {
    const std::string &was = edit.was, &is = edit.is, &there = edit.there;
    if (!was.starts_with('"') || !is.starts_with('"') || !there.starts_with('"') || was == is || was == there)
        return {};
    size_t first = 0, end = 0;  // what both have before what changed, and behind it
    const size_t least = std::min(was.size(), is.size());
    while (first < least && was[first] == is[first]) ++first;
    while (end < least - first && was[was.size() - 1 - end] == is[is.size() - 1 - end]) ++end;
    const auto cuts_word = [&] { return !is_between_words(was, first) || !is_between_words(is, first); };
    while (first > 0 && cuts_word()) --first;
    const auto cuts_word_behind = [&] {
        return !is_between_words(was, was.size() - end) || !is_between_words(is, is.size() - end);
    };
    while (end > 0 && cuts_word_behind()) --end;
    if (first == 0 || end == 0) return {};
    // One character of either side tells that it stands between the same.
    const std::string old = was.substr(first - 1, was.size() - end - first + 2);
    const std::string made = is.substr(first - 1, is.size() - end - first + 2);
    constexpr size_t kShortest = 5;  // with both neighbours
    const bool says_words = old.size() >= kShortest && std::any_of(old.begin(), old.end(), is_part_of_word);
    const size_t at = only_place_in(there, old);
    if (!says_words || at == std::string::npos || only_place_in(was, old) == std::string::npos) return {};
    if (values_shown(was) != values_shown(is) || values_shown(was) != values_shown(there)) return {};
    return there.substr(0, at) + made + there.substr(at + old.size());
}

}  // namespace porttool
