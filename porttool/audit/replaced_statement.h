// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "porttool/audit/aside.h"
#include "porttool/audit/common_texts.h"
#include "porttool/audit/missing_edit.h"

namespace porttool {

/// True where nothing but guards against zero grew, for a side that computes in fewer digits than the other.
bool fits_narrower_type(const WrittenStatement& was, const WrittenStatement& now, const WrittenStatement& there);

/// How sure it is that an edit of a statement is missing where the other side still says what was before.
class ReplacedStatement {
public:
    /// What it is given has to stay.
    ReplacedStatement(const CommonTexts& texts, const BySide<SideOfPair>& pair) : texts_(texts), pair_(pair) {}

    /// True for `f . x = d . x * a`, with the like of `y` beside it, where the other side says `f = d * a` or
    /// `f . xyz = d . xyz * a`. Both in the vocabulary of both sides.
    bool is_one_component(Side side, const std::vector<std::string>& now, const std::vector<std::string>& there) const;

    /// By the manner of the edit, 0 to 1. `was` and `now` are the statement in the vocabulary of both sides.
    float missing(Side side, const MissingPlace& place, const std::vector<std::string>& was,
                  const std::vector<std::string>& now, uint32_t commit) const {
        return (same_head(side, place) ? 1.0f : 0.4f) * (brings_call(side, place) ? 0.5f : 1.0f) *
               (counts_threads_otherwise(place) || takes_own_thread(side, was, now) || is_loop_of_threads(side, place)
                    ? 0.2f
                    : 1.0f) *
               (turns_round(side, place, commit) ? 0.1f : 1.0f) * (says_what_is_gained(side, was, now) ? 0.3f : 1.0f) *
               (stands_there(side, place, was, now) ? 0.2f : 1.0f) * (is_swap(was) && !is_swap(now) ? 0.1f : 1.0f) *
               (fits_narrower_type(place.before, place.now, place.there) ? 0.05f : 1.0f) *
               (lies_otherwise(was, now) ? 0.1f : 1.0f) * (keeps_copy(side, was, now) ? 0.3f : 1.0f) *
               (only_fills_with_zeros(place) ? 0.1f : 1.0f) * (names_second_value(side, was, now) ? 0.1f : 1.0f) *
               (sizes_launch(now) ? 0.2f : 1.0f) * (is_added_later(side, place, now) ? 0.2f : 1.0f);
    }

private:
    /// Names that tell what a statement is about: no types, no words of a letter or two, nothing of the side's own.
    bool tells(Side side, const std::string& word) const;

    /// True if the names that an edit brought are in use on the other side's unit, as often as on this side, or on this
    /// side in such edits alone: then the other side has it in another statement.
    bool says_what_is_gained(Side side, const std::vector<std::string>& before,
                             const std::vector<std::string>& now) const;

    /// True if both begin alike, without a declaration: with the variable that is set, or the word that rules it.
    bool same_head(Side side, const MissingPlace& place) const;

    /// True where a condition became its opposite among other edits: then the branches changed places.
    bool turns_round(Side side, const MissingPlace& place, uint32_t commit) const;

    /// True where the edit calls a function of which the other side has never heard.
    bool brings_call(Side side, const MissingPlace& place) const;

    /// True where one side says how many groups of threads run, and the other how many threads.
    static bool counts_threads_otherwise(const MissingPlace& place);

    /// True where nothing but a local stands for another one that the other side has: what counts threads, or a loop's
    /// variable. Each side has its own.
    bool takes_own_thread(Side side, const std::vector<std::string>& was, const std::vector<std::string>& now) const;

    /// True where the other side's loop begins or steps by which thread runs it.
    bool is_loop_of_threads(Side side, const MissingPlace& place) const;

    /// True where the edit only added names and numbers, and the other side's statement has them all, be it in another
    /// order.
    bool stands_there(Side side, const MissingPlace& place, const std::vector<std::string>& was,
                      const std::vector<std::string>& now) const;

    /// True for `a [ i * n + k ]` that was `a [ i ] [ k ]`: one element, and memory that lies in another way.
    static bool lies_otherwise(const std::vector<std::string>& was, const std::vector<std::string>& now);

    /// True for `a = E` that became `a = b = E` with a `b` that the other side does not have.
    bool keeps_copy(Side side, const std::vector<std::string>& was, const std::vector<std::string>& now) const;

    /// True for `vector < float > a ( n )` that became `a ( n , 0 )`, which it is anyway.
    static bool only_fills_with_zeros(const MissingPlace& place);

    /// True where `b` stands for `a` and the other side says `a = E` where this side has `b = E`: a second value got a
    /// name of its own here.
    ///
    ///     i = ... ; k = i % 4 ; i = i / 4 ; j = i % n ;       k = i % 4 ; row = i / 4 ; j = row % n ;
    bool names_second_value(Side side, const std::vector<std::string>& was, const std::vector<std::string>& now) const;

    /// True for `a = a + E` that was `a = E`, where the other side says `b = E` and adds `b` to something.
    bool is_added_later(Side side, const MissingPlace& place, const std::vector<std::string>& now) const;

    const CommonTexts& texts_;
    const BySide<SideOfPair>& pair_;
};

/// How well the places of a change are known in the other side's statement: what went, and the words beside it,
/// have to stand there. 1 for all, 0.3 for none.
float anchored(const std::vector<std::string>& before, const std::vector<std::string>& now,
               const std::vector<std::string>& there);

/// True for two statements, in the vocabulary of both sides, in which one number, component or operator stands for
/// another, be it at several places: `x . x * x . x + y` and `x . z * x . z + y`.
bool differs_by_a_slip(const std::vector<std::string>& a, const std::vector<std::string>& b);

/// True for two statements, as written, that differ only in how they ask for a thread: `threadIdx . x` and
/// `omp_get_thread_num ( )`, or a local on one side. Numbers have to be the same.
bool runs_other_threads(const std::vector<std::string>& a, const std::vector<std::string>& b);

/// True for two calls with the same arguments, of which three or more stand in another order: so each side's function
/// takes them. Two that changed places may be a slip.
bool takes_in_other_order(const std::vector<std::string>& a, const std::vector<std::string>& b);

/// True for an edit of nothing but numbers.
bool numbers_alone(const WrittenStatement& before, const WrittenStatement& now);

/// What became something else altogether was not edited, but written anew, and what stands elsewhere may say the same:
/// the less `alike` (0 to 1) before and after are, the less an edit of one counts.
inline float still_itself(float alike) { return std::clamp((alike - 0.2f) / 0.4f, 0.2f, 1.0f); }

}  // namespace porttool
