// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "porttool/history/drift_debt.h"
#include "porttool/measure/portability.h"
#include "porttool/read/git_repository.h"

namespace porttool {

/// The figures of a commit.
struct BlockFigures {
    std::vector<MeasuredBlock> blocks;
    std::vector<std::string> contents;  ///< of each block a key, equal only where its files are
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

/// How often a block of the newest commit was touched, beside how alike its sides are.
struct BlockChurn {
    size_t commits = 0;        ///< of those shown, but the first: after which one of its files was another than before
    double per_100_lines = 0;  ///< commits per 100 lines of code, both sides together; 0 without code
};

struct History {
    std::vector<HistoryPoint> points;  ///< oldest first
    std::vector<BlockChurn> churn;     ///< of the newest commit's blocks, in their order
    /// Spearman's, of churn per line and the port's Moss percent over the blocks that have one; none below three of
    /// them, or where all have one rank.
    std::optional<double> churn_and_likeness;
    std::vector<OpenPair> open;  ///< at the newest commit
    size_t commits = 0;          ///< looked at
    bool cut = false;            ///< older commits exist, but not in this shallow clone
    GitCommit oldest;
    MapFile map;                      ///< that the newest commit is read with
    std::vector<BlockReport> newest;  ///< the newest commit's blocks in full, then its totals; empty unless asked for
};

}  // namespace porttool
