// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/effort/port_effort.h"
#include "porttool/read/map_file.h"

namespace porttool {

/// Pairs that the map lacks since their code is new: of a unit that came with the change, on either side, and what the
/// matcher takes for its counterpart, with a score of 0.5 or more. Nothing where no unit is new.
std::vector<MapPair> pairs_of_new_code(const MapFile& map, const ChangedSides& sides);

}  // namespace porttool
