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
    float confidence = 0;         ///< that the pair is right, in [0, 1]
    float margin = 0;             ///< to the next best target
    float body_margin = 0;        ///< the same of the bodies alone
    bool only_one = false;        ///< no other unit of either side has this name
    bool other_role = false;      ///< one of the two launches kernels, the other does something else
    bool unfit = false;           ///< its name, file or calls say that it does something else
    bool wrong_operands = false;  ///< overloads for other types
    bool same_subject = false;    ///< the names are about one thing, which few others are about
    bool fixed = false;           ///< a person paired them
    bool shared = false;          ///< another source has the target as well
    NameDifference names;
};

/// Gives each source at most one target and each target at most one source, the most alike first; what is left may
/// share one that is taken. Fixed pairs come before all others. Done in rounds: the certain pairs of one tell which
/// files belong together and how names change, and so correct the next. Where the units of one side are not `all` there
/// are, nothing is paired for being written like nothing else is.
std::vector<Assignment> assign(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target,
                               const TermNumbers& terms, const std::vector<FixedPair>& fixed,
                               std::vector<std::vector<Candidate>> candidates, bool all);

}  // namespace porttool
