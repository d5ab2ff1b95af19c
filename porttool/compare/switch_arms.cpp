// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/switch_arms.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "porttool/compare/side_by_side.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/statements.h"

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

/// What an arm says: its names, numbers and signs in common words.
struct ArmSays {
    std::vector<std::string> words;
    std::multiset<std::string> signs;
    std::set<std::string> names;

    ArmSays(const Words& tokens, size_t first, size_t end, const Dialect& dialect) {
        const std::vector<std::string> text(tokens.begin() + static_cast<std::ptrdiff_t>(first),
                                            tokens.begin() + static_cast<std::ptrdiff_t>(end));
        for (size_t i = 0; i < text.size(); ++i) {
            const bool is_sign = is_number_token(text[i]) || is_operator(text, i, 0);
            if (!is_sign && (!is_word_token(text[i]) || is_type_word(text[i]) || text[i] == "std")) continue;
            std::string common = is_number_token(text[i]) ? number_value(text[i]) : common_word(text[i], dialect);
            if (common.empty()) common = text[i];
            if (is_sign && common != "=") signs.insert(common);
            if (!is_sign) names.insert(common);
            words.push_back(std::move(common));
        }
    }

    /// Of the same names, for the most part.
    bool is_of_names(const ArmSays& other) const {
        const auto shared = std::count_if(names.begin(), names.end(),
                                          [&](const std::string& name) { return other.names.contains(name); });
        return 2 * static_cast<size_t>(shared) > names.size();
    }
};

/// What a text has for a label whose arm says `here`.
ArmsOfOther held_against(const ArmSays& here, const std::string& label, const Words& there, const Dialect& dialect) {
    ArmsOfOther out = ArmsOfOther::None;
    for (size_t i = 0; i < there.size(); ++i) {
        if (there[i] != "case" || label_at(there, i) != label) continue;
        size_t first = behind_label(there, i);
        while (behind_label(there, first) != first) first = behind_label(there, first);
        const ArmSays other(there, first, end_of_arm(there, first), dialect);
        const bool says_others = here.is_of_names(other) && other.is_of_names(here) &&
                                 (here.signs != other.signs || here.names == other.names);
        const ArmsOfOther found = here.words == other.words ? ArmsOfOther::Same
                                  : says_others             ? ArmsOfOther::Others
                                                            : ArmsOfOther::Any;
        out = std::max(out, found);
    }
    return out;
}

}  // namespace

ArmsOfOther arms_of_other(const LoneTexts& texts, const Dialect& dialect) {
    const Words& now = texts.now;
    const std::set<std::string> then = labels_of(texts.before);
    Words rest;
    ArmsOfOther out = ArmsOfOther::Same;
    bool any = false;
    for (size_t i = 0; i < now.size();) {
        const size_t start = i;
        std::vector<std::string> labels;
        while (behind_label(now, i) != i && !then.contains(label_at(now, i))) {
            labels.push_back(label_at(now, i));
            i = behind_label(now, i);
        }
        if (labels.empty()) {
            rest.push_back(now[i++]);
            continue;
        }
        const size_t end = end_of_arm(now, i);
        const bool falls_in = start > 0 && !is_one_of(now[start - 1], {";", "}", "{"});  // behind another label
        if (falls_in || !is_left(now, i, end)) return ArmsOfOther::None;
        const ArmSays here(now, i, end, dialect);
        for (const std::string& label : labels) out = std::min(out, held_against(here, label, texts.other, dialect));
        any = true;
        i = end;
    }
    return any && rest == texts.before ? out : ArmsOfOther::None;
}

}  // namespace porttool
