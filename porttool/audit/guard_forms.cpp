// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/guard_forms.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

using GuardText = std::vector<std::string>;

/// A value that is kept on one side of a bound.
struct Clamp {
    std::string name;    ///< of the variable, without its components
    bool below = false;  ///< it is not to be less
    bool above = false;
};

/// The variable of `v . x`.
std::string without_components(const GuardText& words, size_t first, size_t end) {
    constexpr std::string_view kComponents = "xyzwrgba";
    if (end >= first + 3 && words[end - 2] == "." && words[end - 1].size() == 1 &&
        kComponents.find(words[end - 1][0]) != std::string_view::npos)
        end -= 2;
    std::string out;
    for (size_t i = first; i < end; ++i) out += words[i];
    return out;
}

/// Of `if ( v . x < bound )` before `v . x = bound`.
std::optional<Clamp> clamp_by_branch(const GuardText& head, const GuardText& set) {
    if (head.size() < 6 || head[0] != "if" || head[1] != "(") return std::nullopt;
    size_t sign = 2;
    while (sign < head.size() && !is_one_of(head[sign], {"<", "<=", ">", ">="})) {
        if (!is_word_token(head[sign]) && head[sign] != ".") return std::nullopt;
        ++sign;
    }
    const size_t length = sign - 2;
    if (sign == head.size() || length == 0 || set.size() <= length || set[length] != "=" ||
        !std::equal(set.begin(), set.begin() + static_cast<ptrdiff_t>(length), head.begin() + 2))
        return std::nullopt;
    return Clamp{without_components(head, 2, sign), head[sign][0] == '<', head[sign][0] == '>'};
}

/// Of `v = max ( v , bound )`, `v = clamp ( ... )`.
std::optional<Clamp> clamp_by_call(const GuardText& words) {
    const size_t sign = static_cast<size_t>(std::find(words.begin(), words.end(), "=") - words.begin());
    if (sign == 0 || sign + 3 >= words.size() || words[sign + 2] != "(") return std::nullopt;
    const std::string& call = words[sign + 1];
    const Clamp out{without_components(words, 0, sign), is_one_of(call, {"max", "fmax", "clamp", "saturate"}),
                    is_one_of(call, {"min", "fmin", "clamp", "saturate"})};
    return out.below || out.above ? std::optional(out) : std::nullopt;
}

bool is_clamp_of(const std::optional<Clamp>& one, const Clamp& wanted) {
    return one && one->name == wanted.name && ((one->below && wanted.below) || (one->above && wanted.above));
}

bool says_it_too(const ReadSide& side, const GuardText& words) {
    return std::find(side.words.begin(), side.words.end(), words) != side.words.end();
}

/// What is asked by `if ( a && b )`, each apart.
std::vector<GuardText> parts_of_condition(const GuardText& head) {
    std::vector<GuardText> out(1);
    int depth = 0;
    for (size_t i = 2; i + 1 < head.size(); ++i) {
        depth += head[i] == "(" ? 1 : head[i] == ")" ? -1 : 0;
        if (depth == 0 && head[i] == "&&")
            out.emplace_back();
        else
            out.back().push_back(head[i]);
    }
    return out;
}

bool ends_as(const GuardText& whole, const GuardText& end) {
    return whole.size() >= end.size() && std::equal(end.rbegin(), end.rend(), whole.rbegin());
}

bool tells_what_it_asks(const GuardText& part) {
    constexpr size_t kTelling = 6;  // letters
    return std::any_of(part.begin(), part.end(),
                       [](const std::string& word) { return is_word_token(word) && word.size() >= kTelling; });
}

}  // namespace

bool is_clamped_otherwise(const ReadSide& here, size_t index, const ReadSide& there) {
    const auto at = [](const ReadSide& side, size_t i) { return i < side.words.size() ? side.words[i] : GuardText(); };
    std::optional<Clamp> branch = clamp_by_branch(at(here, index), at(here, index + 1));
    if (!branch && index > 0) branch = clamp_by_branch(at(here, index - 1), at(here, index));
    if (branch)
        return std::any_of(there.words.begin(), there.words.end(), [&](const GuardText& words) {
            return is_clamp_of(clamp_by_call(words), *branch) && !says_it_too(here, words);
        });
    const std::optional<Clamp> call = clamp_by_call(at(here, index));
    for (size_t i = 0; call && i + 1 < there.words.size(); ++i)
        if (is_clamp_of(clamp_by_branch(there.words[i], there.words[i + 1]), *call) &&
            !says_it_too(here, there.words[i]))
            return true;
    return false;
}

bool is_left_otherwise(const ReadSide& here, size_t index, const ReadSide& there) {
    const auto guarded = [](const ReadSide& side, size_t i) -> std::string {  // by which name
        if (i + 1 >= side.words.size() || side.words[i].size() < 6 || side.words[i + 1].empty()) return {};
        const GuardText& head = side.words[i];
        const bool compares = head[0] == "if" && is_one_of(head[3], {"<", "<=", ">", ">=", "==", "!="});
        const bool leaves = is_one_of(side.words[i + 1][0], {"return", "continue", "break"});
        return compares && leaves && tells_what_it_asks({head[2]}) ? head[2] : std::string();
    };
    const std::string own = guarded(here, index);
    if (own.empty()) return false;
    for (size_t i = 1; i < there.words.size(); ++i)
        if (guarded(there, i) == own && !says_it_too(here, there.words[i])) return true;
    return false;
}

bool is_asked_in_part(const ReadSide& here, size_t index, const ReadSide& there) {
    const GuardText& own = here.words[index];
    if (own.size() < 6 || own[0] != "if" || own[1] != "(") return false;
    const std::vector<GuardText> parts = parts_of_condition(own);
    if (parts.size() < 2) return false;
    return std::any_of(there.words.begin(), there.words.end(), [&](const GuardText& words) {
        if (words.size() < 4 || words[0] != "if" || says_it_too(here, words)) return false;
        const std::vector<GuardText> asked = parts_of_condition(words);
        return asked.size() == 1 && std::any_of(parts.begin(), parts.end(), [&](const GuardText& part) {
                   return tells_what_it_asks(part) && (ends_as(asked[0], part) || ends_as(part, asked[0])) &&
                          tells_what_it_asks(asked[0]);
               });
    });
}

}  // namespace porttool
