// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/match/candidates.h"
#include "porttool/match/name_evidence.h"

namespace porttool {

/// A source unit with the target unit that it is paired with, and what speaks for it.
struct Assignment {
    uint32_t source = 0;
    uint32_t target = 0;
    Resemblance resemblance;
    float score = 0;        ///< with what the other pairs tell about files and names
    float margin = 0;       ///< to the next best target
    bool only_one = false;  ///< no other unit of either side has this name
    NameDifference names;
};

/// Gives each source at most one target and each target at most one source, the most alike first. Done in
/// rounds: the certain pairs of one tell which files belong together and how names change, and so correct the next.
std::vector<Assignment> assign(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target,
                               const TermNumbers& terms, std::vector<std::vector<Candidate>> candidates);

}  // namespace porttool
