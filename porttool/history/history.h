// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "metrics/portability/figure.h"
#include "porttool/history/drift_debt.h"
#include "porttool/read/git_repository.h"

namespace porttool {

/// A block at one commit. The source side comes first; its lines are shared with the files of the other side that it
/// holds pairs with.
struct BlockPoint {
    std::string name;
    std::array<SideMeasure, 2> sides;
    std::optional<metrics::Figure> degree;  ///< of portability, from the target's lines
    bool too_short = false;                 ///< all of its pairs of files are: what is shared is not known
};

/// A commit that touched the sides or the map, with the state that it left.
struct HistoryPoint {
    GitCommit commit;
    std::vector<BlockPoint> blocks;
    BlockPoint totals;
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
};

}  // namespace porttool
