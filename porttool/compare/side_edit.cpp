// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/side_edit.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "porttool/compare/asides.h"
#include "porttool/compare/hints.h"
#include "porttool/compare/side_by_side.h"
#include "porttool/compare/switch_cases.h"
#include "porttool/language/words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/statements.h"
#include "porttool/text/name_words.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

bool is_counted(const Text& text, size_t i, size_t end_of_head) {
    if (is_word_token(text[i])) return !word_is(text[i], kDropped | kPromise | kHeadPromise) && !is_type_word(text[i]);
    return is_number_token(text[i]) || is_operator(text, i, end_of_head);
}

/// `float half = ...`: a name of the text's own.
bool is_declared(const Text& text, size_t i) {
    const bool has_type = i > 0 && is_word_token(text[i - 1]) && text[i - 1] != "return" && text[i - 1] != "case";
    return has_type && i + 1 < text.size() && (text[i + 1] == "=" || text[i + 1] == ";" || text[i + 1] == "[");
}

/// `x != 0` where a truth is asked for is `x`.
Words without_unequal_zero(const Words& words) {
    Words out;
    for (size_t i = 0; i < words.size(); ++i) {
        const bool is_zero = words[i] == "!=" && i + 2 < words.size() && words[i + 1] == "0" &&
                             (words[i + 2] == ")" || words[i + 2] == "&&" || words[i + 2] == "||");
        if (is_zero)
            ++i;
        else
            out.push_back(words[i]);
    }
    return out;
}

}  // namespace

bool brings_part_of(const SideEdit& other, const SideEdit& edit) {
    return std::any_of(edit.gained.begin(), edit.gained.end(), [&](const std::string& word) {
        return is_word_token(word) && !edit.had.contains(word) && times_in(edit.has, word) < times_in(other.has, word);
    });
}

bool are_like(std::string_view a, std::string_view b) {
    const auto parts_of = [](std::string_view name) {
        const std::vector<std::string> words = words_of_name(name);
        return std::set<std::string>(words.begin(), words.end());
    };
    const std::set<std::string> x = parts_of(a), y = parts_of(b);
    size_t shared = 0;
    for (const std::string& part : x) shared += y.contains(part) ? 1 : 0;
    if (2 * shared >= x.size() + y.size() - shared) return true;
    const auto joined = [](std::string_view name) {
        std::string out;
        for (const char c : name)
            if (c != '_') out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return out;
    };
    return joined(a) == joined(b);
}

SideEdit::SideEdit(const Words& before_words, const Words& now_words, const Dialect& dialect) {
    const auto text = [](const Words& words) {
        const Words out = with_sorted_cases(without_unequal_zero(without_asides(without_hints(words))));
        return Text(out.begin(), out.end());
    };
    before = text(before_words);
    now = text(now_words);
    const auto common = [&](const std::string& word) {
        std::string out = common_word(word, dialect);
        return out.empty() ? word : out;
    };
    count_guarded(now, 1);
    count_guarded(before, -1);
    std::erase_if(guarded, [](const auto& each) { return each.second == 0; });
    const size_t old_head = end_of_head(before), new_head = end_of_head(now);
    for (size_t i = 0; i < before.size(); ++i)
        if (is_counted(before, i, old_head)) ++had[common(before[i])];
    for (size_t i = 0; i < now.size(); ++i)
        if (is_counted(now, i, new_head)) ++has[common(now[i])];
    for (const DiffStep& step : diff(before, now)) {
        if (step.kind == DiffStep::Add && is_counted(now, step.now, new_head)) {
            const std::string word = common(now[step.now]);
            const bool is_new = is_word_token(word) && !had.contains(word) && !is_declared(now, step.now);
            if (is_new) new_names.emplace(word, now[step.now]);
            gained.insert(word);
            gained_words += is_name_or_number(word) ? 1 : 0;
            ++size;
        }
        if (step.kind == DiffStep::Remove && is_counted(before, step.before, old_head)) {
            lost.insert(common(before[step.before]));
            ++size;
        }
    }
}

void SideEdit::count_guarded(const std::vector<std::string>& text, long times) {
    static constexpr std::array<std::string_view, 11> kGuarded = {
        "#",        "volatile", "static",   "__attribute__", "uniform",     "varying",
        "coherent", "precise",  "constant", "__constant",    "__constant__"};
    for (const std::string& word : text)
        if (std::find(kGuarded.begin(), kGuarded.end(), word) != kGuarded.end() ||
            word_is(word, kSharedStorage | kKernelAttribute))
            guarded[word] += times;
}

size_t times_in(const std::map<std::string, size_t>& words, const std::string& word) {
    const auto found = words.find(word);
    return found == words.end() ? 0 : found->second;
}

}  // namespace porttool
