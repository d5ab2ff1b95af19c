// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <string>
#include <string_view>

#include "porttool/compare/meaning.h"

namespace porttool {

/// The source's texts in words of the target, as far as the two texts before tell that one stands for the other.
struct LearnedWords {
    Words before, now;
    bool any = false;               ///< a word became another one
    std::deque<std::string> owned;  ///< what the words that changed point into
    LearnedWords() = default;
    LearnedWords(LearnedWords&&) = default;
};

/// Learns from the texts of a pair when it was last in step what each side calls the same thing. A name of the source
/// is one of the target only if the two nearly always stand for each other, and neither side has the other's name.
/// A name that is new on both sides is one where others of the source's differ from the target's in the same part, or
/// where the ids of the pair do (`run_cuda.cu:launchCuda`, `run_hip.cpp:launchHip`).
/// Numbers get the mark of a float where each number without it stands for one that has it.
///
///     source    REAL a = 0.5f ; REAL b = a ;        now also    REAL c = 2.0f ;
///     target    double a = 0.5 ; double b = a ;     now also    double c = 2.0 ;         the same edit
LearnedWords in_words_of_target(const PairTexts& texts, const Dialect& dialect, const BySide<std::string_view>& ids);

}  // namespace porttool
