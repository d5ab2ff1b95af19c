// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "porttool/judge/judge.h"
#include "porttool/judge/lock_store.h"

namespace porttool {

/// What git has at the merge base of a revision and HEAD: the map, the lock, and both sides.
struct BaseTree {
    std::string revision;
    MemoryDisk disk;
    std::string note;  ///< what a user should know of it, or ""
};

/// Reads it. A target side in another checkout is read at the same revision there, else at its HEAD. Throws CannotDo.
BaseTree base_tree(const Project& project, const std::string& revision);

/// Puts the map of the merge base in the place of today's. Throws CannotDo.
void take_map_of_base(Project& project, const std::string& revision, const Disk& on_disk);

/// The map and the lock as the merge base has them.
struct BaseRecord {
    bool has_map = false;
    MapFile map;
    bool has_lock = false;
    RecordedLock lock;
};

/// A map or lock there that cannot be used is as none, with a word on `err`: history cannot be mended. `now`: today's
/// lock, which mostly is the same.
BaseRecord base_record(const Project& project, const BaseTree& tree, const RecordedLock& now, const States& today,
                       std::ostream& err);

/// What --base stands in for the lock: the units of both sides at the merge base, as if they had been accepted there.
struct BaseLock {
    LockFile lock;
    std::map<std::string, std::string> texts;  ///< by fingerprint, as in portmap.base/
    std::vector<PlacedSuppression> suppressions;
};

/// `now` is the lock in force, `then` what it was at the base: a pair whose line changed since and matches today's
/// units was accepted meanwhile and counts as in step.
BaseLock base_lock(const Project& project, const BaseTree& tree, const LockFile& then, const LockFile& now,
                   const States& today);

/// What the index holds of the map, the lock and its texts (maybe nothing); the project gets that map. Throws CannotDo.
MemoryDisk staged_record(Project& project, const Disk& on_disk);

/// Replaces a project's sides by what the index holds, and adds it to the disk. Throws CannotDo.
void read_staged_sides(Project& project, MemoryDisk& disk);

}  // namespace porttool
