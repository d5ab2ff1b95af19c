// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/compare_budget.h"

#include <algorithm>

namespace porttool {
namespace {

constexpr size_t kMostWords = 300'000, kMostAgain = 3'000'000;

/// Each word of a unit's text has a blank or a line break behind it.
size_t count_words(const std::string& text) {
    return static_cast<size_t>(std::count_if(text.begin(), text.end(), [](char c) { return c == ' ' || c == '\n'; }));
}

}  // namespace

std::string CompareBudget::refusal(const UnitState& source, const UnitState& target, const std::string& source_base,
                                   const std::string& target_base) {
    const size_t before = count_words(source_base) + count_words(target_base);
    const size_t longest = std::max({source.tokens, target.tokens, count_words(source_base), count_words(target_base)});
    if (longest > kMostWords)
        return "a text has " + std::to_string(longest) + " tokens, at most " + std::to_string(kMostWords) +
               " are compared";
    const bool known_source = !compared_.insert(&source).second, known_target = !compared_.insert(&target).second;
    if (known_source || known_target) again_ += before + source.tokens + target.tokens;
    if (again_ > kMostAgain) return "long units stand in too many pairs";
    return {};
}

}  // namespace porttool
