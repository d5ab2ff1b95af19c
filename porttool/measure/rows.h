// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/measure/portability.h"

namespace porttool {

/// Code that belongs together, with the row that its lines count in.
struct PlacedCode {
    UnitCode code;
    std::string id;
    int row = -1;
};

/// All pairs, then what stands alone on the source's side, then on the target's; and all code, each line in one row.
struct Rows {
    std::vector<RowReport> rows;
    BySide<std::vector<PlacedCode>> code;
};

/// Measures the pairs. A unit in several pairs counts in the one that it is most alike in, and what no other pair took
/// of a file in the pair of the whole file, if there is one. Blocks are left open.
Rows rows_of(const PortabilityCase& facts);

}  // namespace porttool
