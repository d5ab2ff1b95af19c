// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/sync/block_braces.h"

namespace porttool {

/// How many levels deeper, or less deep, the clauses of a target stand once a transplant is made.
class BlockDepth {
public:
    BlockDepth(const Transplant& transplant, const PlacedUnit& source, const PlacedUnit& target);

    /// Of a clause that stays.
    int of_clause(size_t clause) const { return of_clause_[clause]; }
    /// Of the place where new clauses come, beside what stood there.
    int of_new(size_t batch) const { return of_new_[batch]; }
    /// 1 for a clause of the source that opens a block, -1 for one that closes it, else 0.
    int step(size_t source_clause) const { return step_in(source_, source_clause); }

private:
    static int step_in(const PlacedUnit& unit, size_t clause);

    const PlacedUnit source_;
    std::vector<int> of_clause_;
    std::vector<int> of_new_;  ///< one for each of Transplant::added
};

}  // namespace porttool
