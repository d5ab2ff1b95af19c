// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/judge/check_project.h"

namespace porttool {

/// A unit of the other side, and how sure it is that it is the counterpart.
struct ReviewCandidate {
    std::string id;
    float score = 0;
};

/// Something for a person to look at: a pair that nobody has verified and that the texts do not confirm, or a unit that
/// no pair watches.
struct ReviewItem {
    bool is_pair = false;
    Side side = Side::Source;  ///< of an unwatched unit
    std::string source, target;
    float score = 0;                          ///< of the pair, or of the best candidate
    std::vector<ReviewCandidate> candidates;  ///< best first; of a pair, others than its own
};

/// Doubtful pairs, the least sure first, then unwatched units: kernels first, then by their best candidate.
std::vector<ReviewItem> review_items(const CheckedProject& checked);

}  // namespace porttool
