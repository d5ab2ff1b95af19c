// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/match/candidates.h"

namespace porttool {

/// A source unit with the target unit that it is paired with, and what speaks for it.
struct Assignment {
    uint32_t source = 0;
    uint32_t target = 0;
    Similarity similarity;
    float score = 0;          ///< with the bonus for files that belong together
    float source_margin = 0;  ///< to the next best target
    float free_margin = 0;    ///< to the next best target that no other source claims more strongly
    float target_margin = 0;  ///< to the next best source
    bool only_one = false;    ///< no other unit of either side has this name
    float confidence = 0;     ///< how likely the pair is right, in [0, 1]
};

/// Gives each source at most one target and each target at most one source, the most alike first. Files whose units
/// were paired with certainty draw each other's other units together.
std::vector<Assignment> assign(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target,
                               std::vector<std::vector<Candidate>> candidates);

}  // namespace porttool
