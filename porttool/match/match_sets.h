// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "porttool/match/match.h"
#include "porttool/read/target_sets.h"

namespace porttool {

/// A matching with several ports: each is paired for itself. A source unit is unmapped where no port has it.
struct SetMatching : Matching {
    std::map<std::string, std::vector<std::string>> missing;  ///< by id: the ports that lack it, where others have it
};

/// What a map has settled.
Settled settled_by(const MapFile& map);

/// Pairs the units of the source with those of each port.
SetMatching match_sets(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target,
                       const Settled& settled, const Dialect& dialect, const TargetSets& sets);

}  // namespace porttool
