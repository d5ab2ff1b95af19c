// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "porttool/difftest/leaves.h"

namespace porttool {

/// Inputs in one table, a row a record. A real stands as the bits of a double, any other number as itself.
using InputTable = std::vector<uint64_t>;

/// The narrower of what both sides take, number by number.
std::vector<Leaf> common_inputs(const Leaves& source, const Leaves& target, const LeafMatch& match);

/// Makes `out` a table of so many records, the same on every machine: edges of each number with the others ordinary;
/// ordinary values; values beside the constants that stand in the code; unit vectors; numbers equal to each other; any
/// bits at all. `most`: whole numbers up to that alone, for functions that count to them; 0 for any.
void draw_inputs(const std::vector<Leaf>& leaves, const std::vector<double>& constants, size_t records, uint64_t seed,
                 int64_t most, InputTable& out);

/// The largest size of a real in a record: infinite also where one is no number.
double size_of_record(const uint64_t* record, const std::vector<Leaf>& leaves);

}  // namespace porttool
