// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/effort/changed_side.h"
#include "porttool/effort/ported_edit.h"
#include "porttool/language/dialect.h"
#include "porttool/read/map_file.h"

namespace porttool {

/// A pair with an edit, by its ids.
struct PairEffort {
    std::string source, target;
    PortedEdit edit;
    bool suggested = false;  ///< not in the map: pairs_of_new_code() found it
};

struct PortEffort {
    std::vector<PairEffort> pairs;  ///< sorted by id
    std::vector<FileEffort> source_outside, target_outside;
    PortedEdit totals;  ///< pairs and the rest; the lines of a unit in several pairs count once, its tokens in each
};

/// Both sides before and after a change.
struct ChangedSides {
    const std::vector<ScannedFile>& source_before;
    const std::vector<ScannedFile>& source_now;
    const std::vector<ScannedFile>& target_before;
    const std::vector<ScannedFile>& target_now;
};

/// What it took to port a change: compare_ported() of every pair that was edited, of the map or suggested, and what the
/// rest of both sides gained and lost. What the port gained outside pairs is novel. Nothing in it depends on the order
/// of the pairs or of their targets.
PortEffort port_effort(const std::vector<MapPair>& pairs, const std::vector<MapPair>& suggested,
                       const ChangedSides& sides, const Dialect& dialect);

}  // namespace porttool
