// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/judge/lock_index.h"
#include "porttool/judge/resolve.h"

namespace porttool {

/// One pair of the map, with what its ids lead to.
struct MappedPair {
    BySide<std::string> id;
    int map_line = 0;
    BySide<Resolved> units;
    FoundLock lock;

    /// Of a pair that was recorded.
    const Fingerprints& recorded(Side side) const {
        return side == Side::Source ? lock.pair->source_prints : lock.pair->target_prints;
    }
};

}  // namespace porttool
