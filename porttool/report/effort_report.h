// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "metrics/portability/figure.h"
#include "porttool/effort/port_effort.h"
#include "porttool/read/git_repository.h"

namespace porttool {

/// What porting a range of commits cost.
struct EffortReport {
    GitCommit from, to;
    size_t commits = 0;
    PortEffort effort;
    metrics::LineWeights weights;
    std::vector<metrics::Figure> degrees;          ///< of the whole change, one for each model that has its inputs
    std::optional<metrics::Figure> hours;          ///< predicted from the ledger
    std::optional<metrics::Figure> ledger_degree;  ///< of all recorded ports
    std::vector<std::pair<std::string, metrics::Figure>> ledger_blocks;  ///< of those that name a block, by its name
    std::vector<std::string> missing;  ///< which models have no inputs, and what they need
};

/// DP of an edit from its lines; none where the port gained nothing.
std::optional<metrics::Figure> degree_of_edit(const PortedEdit& edit, const metrics::LineWeights& weights);

std::string effort_table(const EffortReport& report);
std::string effort_json(const EffortReport& report);
/// One line a pair or file, the totals last.
std::string effort_csv(const EffortReport& report);
/// An [[effort]] entry for portmap.toml, to which a person adds the hours.
std::string effort_toml(const EffortReport& report);

}  // namespace porttool
