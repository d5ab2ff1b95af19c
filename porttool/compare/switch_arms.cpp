// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/switch_arms.h"

#include <algorithm>
#include <set>
#include <string>

#include "porttool/normal/declaration_words.h"

namespace porttool {
namespace {

/// Behind the colon of the label at `i`; `i` if there is none.
size_t behind_label(const Words& tokens, size_t i) {
    constexpr size_t kLongest = 16;
    if (i >= tokens.size() || tokens[i] != "case") return i;
    for (size_t k = i; k < tokens.size() && k < i + kLongest; ++k)
        if (tokens[k] == ":") return k + 1;
    return i;
}

std::string label_at(const Words& tokens, size_t i) {
    std::string out;
    for (size_t k = i; k < behind_label(tokens, i); ++k) out.append(tokens[k]) += ' ';
    return out;
}

std::set<std::string> labels_of(const Words& tokens) {
    std::set<std::string> out;
    for (size_t i = 0; i < tokens.size(); ++i)
        if (tokens[i] == "case") out.insert(label_at(tokens, i));
    return out;
}

/// Where the arm ends whose body begins at `i`.
size_t end_of_arm(const Words& tokens, size_t i) {
    int depth = 0;
    for (; i < tokens.size(); ++i) {
        if (depth == 0 && is_one_of(tokens[i], {"case", "default", "}"})) return i;
        depth += tokens[i] == "{" ? 1 : tokens[i] == "}" ? -1 : 0;
    }
    return i;
}

/// True if the last statement of an arm leaves it, whatever was decided before.
bool is_left(const Words& tokens, size_t first, size_t end) {
    size_t braces = 0;
    while (end > first && tokens[end - 1] == "}") --end, ++braces;
    if (braces > 1 || end == first || tokens[end - 1] != ";") return false;
    size_t start = end - 1;
    while (start > first && !is_one_of(tokens[start - 1], {";", "{", "}", ":"})) --start;
    const bool own_block = braces == 0 || tokens[first] == "{";
    const bool guarded = start > first && tokens[start - 1] == "{" && start - 1 != first;
    return own_block && !guarded && is_one_of(tokens[start], {"break", "return", "continue", "goto"});
}

}  // namespace

bool only_adds_arms_of_other(const Words& before, const Words& now, const Words& other) {
    const std::set<std::string> then = labels_of(before), there = labels_of(other);
    Words rest;
    bool any = false;
    for (size_t i = 0; i < now.size();) {
        const size_t start = i;
        bool all_new = false, all_known = true;
        while (behind_label(now, i) != i && !then.contains(label_at(now, i))) {
            all_new = true;
            all_known = all_known && there.contains(label_at(now, i));
            i = behind_label(now, i);
        }
        if (!all_new) {
            rest.push_back(now[i++]);
            continue;
        }
        const size_t end = end_of_arm(now, i);
        const bool falls_in = start > 0 && !is_one_of(now[start - 1], {";", "}", "{"});  // behind another label
        if (!all_known || falls_in || !is_left(now, i, end)) return false;
        any = true;
        i = end;
    }
    return any && rest == before;
}

}  // namespace porttool
