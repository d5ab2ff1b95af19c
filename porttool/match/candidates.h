// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/match/resemblance.h"

namespace porttool {

struct Candidate {
    uint32_t source = 0;
    uint32_t target = 0;
    Resemblance resemblance;
};

/// For each source unit the target units that resemble it most, best first. An inverted index over the terms finds
/// them, so that the time grows with what units have in common and not with the product of their numbers.
std::vector<std::vector<Candidate>> find_candidates(const std::vector<UnitFeatures>& source,
                                                    const std::vector<UnitFeatures>& target, size_t most);

}  // namespace porttool
