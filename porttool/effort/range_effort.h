// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "metrics/portability/figure.h"
#include "porttool/effort/port_effort.h"
#include "porttool/snapshot/past.h"

namespace porttool {

/// What porting a range of commits cost.
struct RangeEffort {
    GitCommit from, to;
    size_t commits = 0;
    PortEffort effort;
    metrics::LineWeights weights;
    std::vector<metrics::Figure> degrees;          ///< of the whole change, one for each model that has its inputs
    std::optional<metrics::Figure> hours;          ///< predicted from the ledger, linear in lines
    std::optional<metrics::Figure> hours_by_law;   ///< the same by Hakuta and Ohminami's equation
    std::optional<metrics::Figure> ledger_degree;  ///< of all recorded ports
    std::vector<std::pair<std::string, metrics::Figure>> ledger_blocks;  ///< of those that name a block, by its name
    std::vector<std::string> missing;  ///< which models have no inputs, and what they need
};

/// Reads both commits and compares them. The map that names the pairs is the given one, else that of `to`, of `from`,
/// of today. Files that cannot be read are named in `notes`. Throws CannotDo where there is no map, or one that cannot
/// be read or names no sides.
RangeEffort range_effort(const Past& past, const GitCommit& from, const GitCommit& to, std::ostream& notes);

}  // namespace porttool
