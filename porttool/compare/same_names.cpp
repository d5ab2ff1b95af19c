// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/same_names.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/compare/asides.h"
#include "porttool/compare/runtime_calls.h"
#include "porttool/language/words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/normal_form.h"

namespace porttool {
namespace {

using NamesOfEdit = std::set<std::string>;

bool is_of_runtime(std::string_view word) {
    return is_runtime_call(word) || word.starts_with("cl_") || word.starts_with("CL_") || word.starts_with("omp_");
}

/// What an edit brought and took: names, and numbers by their values. A number of dimensions is the manner's.
struct BroughtAndTaken {
    NamesOfEdit came, went;

    BroughtAndTaken(const Words& before, const Words& now) {
        for (const DiffStep& step : diff(before, now)) {
            if (step.kind == DiffStep::Keep) continue;
            const bool is_new = step.kind == DiffStep::Add;
            add(is_new ? now : before, is_new ? step.now : step.before, is_new ? came : went);
        }
    }

private:
    static void add(const Words& text, size_t i, NamesOfEdit& to) {
        const std::string_view word = text[i];
        const std::string_view before = i > 0 ? text[i - 1] : std::string_view();
        const std::string_view after = i + 1 < text.size() ? text[i + 1] : std::string_view();
        if (is_number_token(word)) {
            if (!(before == "<" && after == ">")) to.insert(number_value(word));
        } else if (is_word_token(word) && !is_type_word(word) && !word_is(word, kKeyword) && !is_of_runtime(word)) {
            to.emplace(word);
        }
    }
};

/// True if one side brought what the other did, but for names that the other's texts do not have.
bool are_covered(const NamesOfEdit& own, const NamesOfEdit& there, const std::set<std::string_view>& known_there) {
    return std::all_of(own.begin(), own.end(), [&](const std::string& word) {
        if (there.contains(word)) return true;
        return is_word_token(word) ? !known_there.contains(word) : word == "1" || word == "0";
    });
}

bool launches_in_brackets(const Words& text) {
    for (size_t i = 0; i < text.size(); ++i)
        if (opens_launch(text, i)) return true;
    return false;
}

/// The names among `common` that each of them is given where it is called, call by call; of launches also those for how
/// many threads, if asked for.
std::multiset<std::string> calls_of(const Words& text, const NamesOfEdit& common, bool with_launches) {
    constexpr size_t kLongest = 400;
    std::multiset<std::string> out;
    for (size_t i = 0; i + 1 < text.size(); ++i) {
        if (!is_word_token(text[i]) || !common.contains(std::string(text[i]))) continue;
        size_t open = i + 1;
        if (text[open] == "<")  // template arguments, or a launch
            while (open < text.size() && open < i + kLongest && text[open] != ";" &&
                   !(text[open] == "(" && text[open - 1] == ">"))
                ++open;
        if (open >= text.size() || text[open] != "(") continue;
        std::string call = std::string(text[i]) + ":";
        for (size_t k = i + 1; with_launches && k < open; ++k)
            if (is_word_token(text[k]) && common.contains(std::string(text[k]))) (call += ' ') += text[k];
        int depth = 0;
        for (size_t k = open; k < std::min(text.size(), open + kLongest); ++k) {
            depth += text[k] == "(" ? 1 : text[k] == ")" ? -1 : 0;
            if (depth == 0) break;
            if (is_word_token(text[k]) && common.contains(std::string(text[k]))) (call += ' ') += text[k];
        }
        out.insert(std::move(call));
    }
    return out;
}

}  // namespace

bool bring_the_same_names(const PairTexts& texts) {
    constexpr size_t kMost = 12'000, kLeast = 4;  // words of all texts; names that both brought
    const auto size =
        texts.source_before.size() + texts.source_now.size() + texts.target_before.size() + texts.target_now.size();
    if (size > kMost || !drives_device(texts.source_now) || !drives_device(texts.target_now)) return false;
    const Words plain[] = {without_asides(texts.source_before), without_asides(texts.source_now),
                           without_asides(texts.target_before), without_asides(texts.target_now)};
    const BroughtAndTaken here(plain[0], plain[1]), there(plain[2], plain[3]);
    const auto known = [&](size_t first) {
        std::set<std::string_view> out(plain[first].begin(), plain[first].end());
        out.insert(plain[first + 1].begin(), plain[first + 1].end());
        return out;
    };
    const std::set<std::string_view> of_source = known(0), of_target = known(2);
    if (!are_covered(here.came, there.came, of_target) || !are_covered(here.went, there.went, of_target) ||
        !are_covered(there.came, here.came, of_source) || !are_covered(there.went, here.went, of_source))
        return false;
    NamesOfEdit common;
    for (const std::string& word : here.came)
        if (there.came.contains(word)) common.insert(word);
    const bool launch_alike = launches_in_brackets(plain[1]) && launches_in_brackets(plain[3]);
    const auto gained_calls = [&](size_t then) {
        std::multiset<std::string> out = calls_of(plain[then + 1], common, launch_alike);
        for (const std::string& call : calls_of(plain[then], common, launch_alike))
            if (const auto known_call = out.find(call); known_call != out.end()) out.erase(known_call);
        return out;
    };
    return common.size() >= kLeast && gained_calls(0) == gained_calls(2);
}

}  // namespace porttool
