// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/declaration_edit.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "porttool/language/words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

constexpr std::array<std::string_view, 12> kWide = {"int64_t",   "uint64_t", "size_t", "ssize_t",
                                                    "ptrdiff_t", "long",     "ulong",  "longlong",
                                                    "ulonglong", "int64",    "uint64", "intptr_t"};

bool is_constant(const std::string& word) {
    constexpr size_t kLeast = 3;
    return word.size() >= kLeast && is_word_token(word) &&
           std::none_of(word.begin(), word.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

/// The value of `T name = value`; "" for none.
Text declared_value(const Text& words, std::string& name) {
    const auto sign = std::find(words.begin(), words.end(), "=");
    if (sign == words.end() || sign - words.begin() < 2) return {};
    name = *(sign - 1);
    return {sign + 1, words.end()};
}

}  // namespace

bool declares_another_value(const Text& before, const Text& now) {
    std::string old_name, new_name;
    const Text old_value = declared_value(before, old_name), new_value = declared_value(now, new_name);
    if (old_value.empty() || new_value.empty() || old_name != new_name) return false;
    const std::vector<DiffStep> steps = diff(old_value, new_value);
    return std::any_of(steps.begin(), steps.end(), [&](const DiffStep& step) {
        if (step.kind != DiffStep::Add) return false;
        const std::string& word = new_value[step.now];
        return is_number_token(word) || is_constant(word);
    });
}

size_t wide_integers_in(const Text& words) {
    return static_cast<size_t>(std::count_if(words.begin(), words.end(), [](const std::string& word) {
        return std::find(kWide.begin(), kWide.end(), word) != kWide.end();
    }));
}

bool can_overflow(const Text& words) {
    return std::any_of(words.begin(), words.end(), [](const std::string& word) {
        return word == "*" || word == "<<" || word == "*=" || word == "+=";
    });
}

}  // namespace porttool
