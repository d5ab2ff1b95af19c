// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/variable_type.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

constexpr uint32_t kNowhere = ~uint32_t{0};
constexpr uint32_t kMostLookedBack = 256;  ///< tokens of a list of variables before the one that is asked for

/// Where the variable's name stands. Of a block of GLSL the tokens are its head, and the variable stands behind them.
uint32_t place_of_name(const Definition& variable) {
    const LexedText& lexed = variable.file->lexed;
    const auto count = static_cast<uint32_t>(lexed.tokens.size());
    for (uint32_t i = variable.tokens.first; i + 1 < std::min(variable.tokens.end + 16, count); ++i)
        if (lexed.view(i) == variable.name) return i;
    return kNowhere;
}

/// The bracket that the one at `close` closes; kNowhere where none does.
uint32_t opening_of(const LexedText& lexed, uint32_t close) {
    int depth = 0;
    for (uint32_t i = close + 1; i-- > 0;) {
        if (is_one_of(lexed.view(i), {")", "]", "}"})) ++depth;
        if (is_one_of(lexed.view(i), {"(", "[", "{"}) && --depth == 0) return i;
    }
    return kNowhere;
}

/// The name of the variable with which a list begins that has another one at `name`; kNowhere where that is none.
uint32_t first_of_list(const LexedText& lexed, uint32_t name) {
    uint32_t first = kNowhere;  // behind what was gone through
    for (uint32_t i = name; i > 0 && name - i < kMostLookedBack;) {
        const std::string_view word = lexed.view(--i);
        const bool ends_value = is_one_of(word, {")", "]", "}"});
        const bool begins = is_one_of(word, {";", "{", "("}) || (lexed.tokens[i].flags & kInDirective) != 0;
        if (begins) break;
        if (ends_value) {
            const uint32_t open = opening_of(lexed, i);
            const bool is_value = open != kNowhere && open > 0 && is_one_of(lexed.view(open - 1), {"=", "]", ")", ","});
            const bool is_bound = open != kNowhere && lexed.view(open) == "[";
            if (!is_value && !is_bound) break;  // of a function before it
            i = open;
        }
        first = i;
    }
    if (first == kNowhere) return kNowhere;
    for (uint32_t i = first; i + 1 < name; ++i)
        if (is_one_of(lexed.view(i + 1), {"=", ",", "["})) return i;
    return kNowhere;
}

/// Over `*`, `const` and `restrict` before a name; counts the stars.
uint32_t before_stars(const LexedText& lexed, uint32_t name, int& stars) {
    uint32_t i = name;
    while (i > 0 && (lexed.view(i - 1) == "*" || word_is(lexed.view(i - 1), kQualifier))) {
        if (lexed.view(i - 1) == "*") ++stars;
        --i;
    }
    return i;
}

/// The words of a type that end before `end`: `unsigned int`.
std::string type_before(const LexedText& lexed, uint32_t end) {
    if (end == 0 || lexed.tokens[end - 1].kind != TokenKind::Identifier) return {};
    std::string out(lexed.view(end - 1));
    for (uint32_t i = end - 1; i > 0 && word_is(lexed.view(i), kTypePart) && word_is(lexed.view(i - 1), kTypePart); --i)
        out = std::string(lexed.view(i - 1)) + " " + out;
    return out;
}

/// The bounds behind a name, and what stands behind them. An open one, `[]`, is none.
std::string bounds_behind(const LexedText& lexed, uint32_t& i, bool& is_open) {
    std::string out;
    const auto count = static_cast<uint32_t>(lexed.tokens.size());
    while (i + 1 < count && lexed.view(i) == "[") {
        if (lexed.view(i + 1) == "]") {
            is_open = true;
            i += 2;
            continue;
        }
        int depth = 0;
        for (; i < count; ++i) {
            out += std::string(lexed.view(i)) + " ";
            if (lexed.view(i) == "[") ++depth;
            if (lexed.view(i) == "]" && --depth == 0) break;
        }
        ++i;
    }
    return out;
}

}  // namespace

VariableType type_of_variable(const Definition& variable) {
    const LexedText& lexed = variable.file->lexed;
    const uint32_t name = place_of_name(variable);
    if (name == kNowhere || name == 0) return {};
    VariableType out;
    bool is_open = false;
    uint32_t next = name + 1;
    out.bounds = bounds_behind(lexed, next, is_open);
    if (next >= lexed.tokens.size() || !is_one_of(lexed.view(next), {";", "=", "{", ","})) return {};
    int stars = 0;
    uint32_t end = before_stars(lexed, name, stars);
    if (end > 0 && lexed.view(end - 1) == ",") {
        const uint32_t first = first_of_list(lexed, name);
        int of_first = 0;
        end = first == kNowhere ? 0 : before_stars(lexed, first, of_first);
    }
    out.leads_on = stars == 1 || is_open;
    if (stars > 1 || (out.leads_on && !out.bounds.empty()) || (stars == 1 && is_open)) return {};
    out.name = type_before(lexed, end);
    return out;
}

std::string declaration_of(const Definition& variable) {
    const VariableType type = type_of_variable(variable);
    return type.name + (type.leads_on ? "* " : " ") + variable.name + type.bounds + ";\n";
}

}  // namespace porttool
