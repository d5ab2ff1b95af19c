// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "porttool/normal/units_by_id.h"
#include "porttool/read/lock_file.h"
#include "porttool/read/lock_lines.h"
#include "porttool/read/map_file.h"
#include "porttool/read/source_files.h"

namespace porttool {

/// The line of the lock that holds for a pair of the map.
struct FoundLock {
    const LockedPair* pair = nullptr;
    bool under_old_ids = false;  ///< the map was edited since: the line has the ids from before
};

/// Finds the lock's line for a pair, also where the map was given new ids after a move: a line whose pair the map no
/// longer names holds for two units whose texts are the recorded ones.
class LockIndex {
public:
    using Units = UnitsById;
    LockIndex(const MapFile& map, const LockFile& lock, const Units& source, const Units& target);

    FoundLock find(const std::string& source, const std::string& target) const;

private:
    const Units& source_;
    const Units& target_;
    LinesByPair lines_;
    std::map<std::pair<Print, Print>, const LockedPair*> left_over_;  ///< by the prints of both texts
};

/// Drops what holds for nothing any more: lines of pairs that the map does not name, unless a pair without a line of
/// its own was moved from there; units of the baseline, and verdicts, whose unit is gone. Files that could not be read
/// (`skipped`) may still have theirs.
void drop_idle_lines(LockFile& lock, const MapFile& map, const LockIndex::Units& source, const LockIndex::Units& target,
                     const std::vector<SkippedFile>& skipped);

}  // namespace porttool
