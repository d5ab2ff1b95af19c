// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/history/drift_debt.h"
#include "porttool/measure/portability.h"
#include "porttool/read/git_repository.h"

namespace porttool {

/// The figures of a commit.
struct BlockFigures {
    std::vector<MeasuredBlock> blocks;
    MeasuredBlock totals;
};

/// A commit that touched the sides or the map, with the state that it left.
struct HistoryPoint {
    GitCommit commit;
    std::vector<MeasuredBlock> blocks;
    MeasuredBlock totals;
    size_t pairs = 0;  ///< of the map, with both sides there
    size_t open_pairs = 0;
    double debt = 0;         ///< line-days
    double debt_before = 0;  ///< the same an instant before the commit
};

struct History {
    std::vector<HistoryPoint> points;  ///< oldest first
    std::vector<OpenPair> open;        ///< at the newest commit
    size_t commits = 0;                ///< looked at
    bool cut = false;                  ///< older commits exist, but not in this shallow clone
    GitCommit oldest;
    MapFile map;                      ///< that the newest commit is read with
    std::vector<BlockReport> newest;  ///< the newest commit's blocks in full, then its totals; empty unless asked for
};

}  // namespace porttool
