// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/around.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "porttool/audit/aside.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/statements.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

constexpr float kCounterpart = 0.6f;  ///< from that likeness on one statement may be the other's counterpart

/// Words of what refuses to go on: that is more than a message.
constexpr std::array<std::string_view, 8> kRefusals = {"throw",  "abort", "assert",  "error",
                                                       "except", "fatal", "support", "exit"};

bool is_governing_head(const Text& words) {
    return words.size() > 1 && words[1] == "(" && is_one_of(words[0], {"if", "for", "while"});
}

float nearest_likeness(const WeighedWords& one, const std::vector<WeighedWords>& among) {
    const Nearest near = nearest(one, among);
    return near.any ? likeness(one, among[near.index]) : 0;
}

/// What a line of the preprocessor does: "if", "else", "endif"; "" for all other statements.
std::string_view branch_word(const WrittenStatement& statement) {
    const Text words = words_of_statement(statement);
    if (words.size() < 2 || words[0] != "#") return {};
    if (words[1].starts_with("if")) return "if";
    if (is_one_of(words[1], {"else", "elif", "elifdef"})) return "else";
    return words[1] == "endif" ? "endif" : "";
}

/// A walk from a statement in one direction to the ends of its branch and of the whole `#if`; both are the statement's
/// own place where it stands in none.
struct BranchEnds {
    size_t branch, whole;
};
BranchEnds branch_ends(const ReadSide& side, size_t index, bool forward) {
    const std::string_view opens = forward ? "if" : "endif", closes = forward ? "endif" : "if";
    BranchEnds out{index, index};
    int depth = 0;
    for (size_t i = index; forward ? i + 1 < side.written.size() : i > 0;) {
        i = forward ? i + 1 : i - 1;
        const std::string_view kind = branch_word(side.written[i]);
        if (kind == opens) ++depth;
        if (depth == 0 && (kind == "else" || kind == closes) && out.branch == index) out.branch = i;
        if (depth == 0 && kind == closes) {
            out.whole = i;
            return out;
        }
        if (kind == closes) --depth;
    }
    return {index, index};
}

}  // namespace

bool heads_a_message(const ReadSide& side, size_t index) {
    if (!is_governing_head(side.words[index]) || index + 1 >= side.written.size()) return false;
    const Text next = words_of_statement(side.written[index + 1]);
    const bool refuses = std::any_of(next.begin(), next.end(), [](const std::string& word) {
        return std::any_of(kRefusals.begin(), kRefusals.end(),
                           [&](std::string_view part) { return holds_in_any_case(word, part); });
    });
    return branch_word(side.written[index + 1]).empty() && is_aside(next) && !refuses;
}

bool is_alternative(const ReadSide& side, size_t index, const ReadSide& other) {
    const BranchEnds back = branch_ends(side, index, false), on = branch_ends(side, index, true);
    if (back.whole == index || on.whole == index) return false;
    for (size_t i = back.whole; i <= on.whole; ++i) {
        const bool same_branch = i >= back.branch && i <= on.branch;
        if (!same_branch && likeness(side.weighed[i], side.weighed[index]) >= kCounterpart &&
            nearest_likeness(side.weighed[i], other.weighed) >= kCounterpart)
            return true;
    }
    return false;
}

std::optional<float> shared_around(const ReadSide& side, size_t index, const ReadSide& other) {
    constexpr size_t kNear = 5;            // statements before and behind
    constexpr float kMostOfStatement = 8;  // a long one is not worth more than so many words
    float all = 0, shared = 0;
    const size_t end = std::min(side.weighed.size(), index + kNear + 1);
    for (size_t i = std::max<size_t>(1, index - std::min(index, kNear)); i < end; ++i) {
        if (i == index) continue;
        const float weight = std::min(side.weighed[i].sum, kMostOfStatement);
        const Nearest near = nearest(side.weighed[i], other.weighed);
        all += weight;
        if (near.any && near.distance <= 0) shared += weight;
    }
    return all > 0 ? std::optional(shared / all) : std::nullopt;
}

bool governs_the_same(const ReadSide& side, size_t index, const ReadSide& other) {
    constexpr float kSame = 0.75f, kTelling = 3;
    if (!is_governing_head(side.words[index]) || index + 1 >= side.words.size()) return false;
    const WeighedWords& next = side.weighed[index + 1];
    const Nearest near = nearest(next, other.weighed);
    if (!near.any || near.index < 2 || next.sum < kTelling || likeness(next, other.weighed[near.index]) < kSame)
        return false;
    const Text& head = other.words[near.index - 1];
    return is_governing_head(head) && head[0] == side.words[index][0] &&
           nearest_likeness(other.weighed[near.index - 1], side.weighed) < kCounterpart;
}

}  // namespace porttool
