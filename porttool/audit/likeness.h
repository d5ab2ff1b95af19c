// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "porttool/text/text_numbers.h"

namespace porttool {

/// The words of a statement with how much each counts: names, numbers and operators say what is done, brackets and
/// commas hardly.
struct WeighedWords {
    std::vector<uint32_t> words;  ///< by number
    std::vector<float> weights;
    float sum = 0;
};

/// Numbers words; those of one weigher can be compared. Of a very long statement it takes the first words.
class Weigher {
public:
    WeighedWords weighed(const std::vector<std::string>& words);

private:
    TextNumbers numbers_;
};

/// The weight of what two statements have in common in one order.
float common_weight(const WeighedWords& a, const WeighedWords& b);

/// Twice the common words of two statements in one order by all, 0 to 1, brackets and commas left out. Names count as
/// the same where one ends with the other: `clamp` and `spectrumclamp`.
float likeness_by_endings(const std::vector<std::string>& a, const std::vector<std::string>& b);

/// What one has and the other has not, in weight; 0 for equal ones.
inline float distance(const WeighedWords& a, const WeighedWords& b) { return a.sum + b.sum - 2 * common_weight(a, b); }

/// Twice the common weight by all, 0 to 1.
inline float likeness(const WeighedWords& a, const WeighedWords& b) {
    return a.sum + b.sum > 0 ? 2 * common_weight(a, b) / (a.sum + b.sum) : 1.0f;
}

}  // namespace porttool
