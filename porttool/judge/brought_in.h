// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/judge/judge.h"

namespace porttool {

/// What decides over findings, at one time.
struct GateState {
    bool has_map = false;
    const MapFile& map;
    bool has_lock = false;
    const LockFile& lock;
    const std::vector<PlacedSuppression>& suppressions;
};

/// What of it a change brings in, or takes away; sorted by file and line. `map_name`: as it is shown.
std::vector<BroughtIn> brought_in(const GateState& before, const GateState& now, const std::string& map_name);

/// Those of today's suppressions that were there before.
std::vector<PlacedSuppression> known_before(const std::vector<PlacedSuppression>& now,
                                            const std::vector<PlacedSuppression>& before);

}  // namespace porttool
