// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/match/resemblance.h"

namespace porttool {

/// Two units, by their numbers, that a person has paired.
struct FixedPair {
    uint32_t source = 0;
    uint32_t target = 0;
};

/// Two units by their numbers, and how sure it is that they belong together.
struct UnitPair {
    uint32_t source = 0, target = 0;
    float confidence = 0;
};

struct Candidate {
    uint32_t source = 0;
    uint32_t target = 0;
    Resemblance resemblance;
};

/// For each source unit the target units that resemble it most, best first; for one that is fixed those that it has. An
/// inverted index over the terms finds them, so that the time grows with what units have in common and not with the
/// product of their numbers.
std::vector<std::vector<Candidate>> find_candidates(const std::vector<UnitFeatures>& source,
                                                    const std::vector<UnitFeatures>& target,
                                                    const std::vector<FixedPair>& fixed, size_t most);

}  // namespace porttool
