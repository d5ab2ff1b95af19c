// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "porttool/effort/range_effort.h"

namespace porttool {

/// DP of an edit from its lines; none where the port gained nothing.
std::optional<metrics::Figure> degree_of_edit(const PortedEdit& edit, const metrics::LineWeights& weights);

std::string effort_table(const RangeEffort& report);
std::string effort_json(const RangeEffort& report);
/// One line a pair or file, the totals last.
std::string effort_csv(const RangeEffort& report);
/// An [[effort]] entry for portmap.toml, to which a person adds the hours.
std::string effort_toml(const RangeEffort& report);

}  // namespace porttool
