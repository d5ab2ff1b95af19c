// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/audit/around.h"
#include "porttool/audit/common_texts.h"
#include "porttool/audit/guard_forms.h"

namespace porttool {

/// Whether a statement that one side of a pair has alone is said on the other side in other words.
///
///     if ( lid != best [ bid ] ) return ;       if ( threadIdx . x != best [ blockIdx . x ] ) return ;
class SaidOtherwise {
public:
    /// What it is given has to stay.
    SaidOtherwise(const CommonTexts& texts, const BySide<SideOfPair>& pair) : texts_(texts), pair_(pair) {}

    /// True if it surely is, or has no need to be.
    bool is_said(Side side, size_t index) const {
        return stands_alike_in_file(side, index) || is_said_in_unit(side, index);
    }

    /// The same, whatever other functions say: of a guard, which many functions have.
    bool is_said_in_unit(Side side, size_t index) const {
        return has_in_shape(side, index) || only_brings(side, index) || only_guards(side, index) ||
               is_part_of_swap(side, index) || is_bound_of_loop(side, index) || names_value(side, index) ||
               is_label_by_ending(side, index) || heads_a_message(texts_.sides[side], index) ||
               is_clamped_otherwise(texts_.sides[side], index, texts_.sides[other(side)]) ||
               is_asked_in_part(texts_.sides[side], index, texts_.sides[other(side)]) ||
               is_alternative(texts_.sides[side], index, texts_.sides[other(side)]);
    }

    /// How sure it is that it is not, 0 to 1, by its words, its names and the statements around it.
    float lacking(Side side, size_t index) const;

    /// True where most names that the other side's unit does not use stand in one function that it calls: there it
    /// may say the same.
    bool is_said_in_call(Side side, size_t index) const;

    /// How well the statements around one are known to the other side, 0 to 1.
    float neighbours(Side side, size_t index) const;

private:
    /// True if the other side has a statement of the same shape that says some of the same names and has no better
    /// counterpart on this side.
    bool has_in_shape(Side side, size_t index) const;

    /// True if some other function of the other side's file says nearly the same: a port may be spread over several.
    bool stands_alike_in_file(Side side, size_t index) const;

    /// True for a statement that only names a value, be it in its side's own manner: `n = LOAD ( p . n [ i + 1 ] )`.
    bool only_brings(Side side, size_t index) const;

    /// True for `if ( p )` with nothing but a local of the unit: whether it may be null is the side's own affair.
    bool only_guards(Side side, size_t index) const;

    /// True for `a = t`, of the three that make `a` and `b` change places, where the other side calls `swap ( a , b )`.
    bool is_part_of_swap(Side side, size_t index) const;

    /// True for `if ( i >= n )` or `if ( i < n )` of a thread `i`, where the other side has a loop that ends at `n`.
    bool is_bound_of_loop(Side side, size_t index) const;

    /// True for a label of a switch: few words, which say all.
    bool is_label(Side side, size_t index) const;

    /// True for a label that the other side has with something before it: `case clMirror` and `case mirror`.
    bool is_label_by_ending(Side side, size_t index) const;

    /// True for the declaration of a local that the other side does not have, or is given: what matters is where it is
    /// used, and there its value is written out.
    bool names_value(Side side, size_t index) const;

    /// True for numbers that a local of a class begins with, `m . row = float3 ( 0 , 1 , 0 )`, where the local is of
    /// another class on the other side: what that begins with, its constructor says.
    bool begins_own_class(Side side, size_t index) const;

    /// Less than 1 where the other side sets the same variable as often: then it does so in another way.
    float sets_new(Side side, size_t index) const;

    /// Less than 1 for what a variable gets, or a member of one, that the other side's file does not name: what matters
    /// is where it is used.
    float sets_own_local(Side side, size_t index) const;

    /// Less than 1 for a statement that calls what its side uses throughout and the other nowhere: what such a call
    /// does, the other side says in its own way, or has not at all.
    float in_common_calls(Side side, size_t index) const;

    /// Less than 1 for a loop where the other side is run by many threads and this one is not: those are its turns.
    float runs_threads(Side side, size_t index) const;

    /// How well the other side's unit knows a statement's names.
    float known_names(Side side, size_t index) const;

    /// Less than 1 where a single statement of the other side has all names that tell what this one is about.
    float said_in_one(Side side, size_t index) const;

    /// 1 where the other side's unit uses some word of a statement less often than this one; less where it uses each as
    /// often: then it may say the same in another way.
    float lacks_words(Side side, size_t index) const;

    const CommonTexts& texts_;
    const BySide<SideOfPair>& pair_;
};

}  // namespace porttool
