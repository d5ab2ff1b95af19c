// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "porttool/command/lock_store.h"

namespace porttool {

/// What --base stands in for the lock: the units of both sides at the merge base, as if they had been accepted there.
struct BaseLock {
    LockFile lock;
    std::map<std::string, std::string> texts;  ///< by fingerprint, as in portmap.base/
    std::string note;                          ///< what a user should know of it, or ""
};

/// Reads the merge base of `revision` and HEAD. `lock` is today's lock, if there is one: a pair whose line in it
/// changed since the base and matches today's units was accepted meanwhile and counts as in step. A target side in
/// another checkout is read at the same revision there, else at its HEAD, else as it is. Throws CannotDo.
BaseLock base_lock(const Project& project, const std::string& revision, const LockFile& lock, const States& today);

/// Replaces a project's map and sides by what the index holds, and gives what of the lock and its texts is there (maybe
/// nothing). Throws CannotDo.
MemoryDisk read_staged_sides(Project& project);

}  // namespace porttool
