// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The lines of portmap.toml, portmap.lock and portmap.base/ that new pairs need.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "porttool/judge/check_project.h"

namespace porttool {

/// Two units that become a pair, in step as they are.
struct FreshPair {
    UnitState source, target;
};

/// What becomes of the project's own files.
struct RecordEdits {
    std::vector<FreshPair> made;
    std::vector<BySide<std::string>> in_step;  ///< pairs that are no longer deferred
    std::vector<BySide<std::string>> removed;  ///< pairs of units that are gone
};

/// A project's own file, by its path relative to the root.
struct RecordFile {
    std::string before, now;
    bool is_new = false;
};

/// The project's own files as they become.
class PairRecord {
public:
    /// Both must outlive it.
    PairRecord(const CheckedProject& checked, const Disk& disk) : checked_(checked), disk_(disk) {}

    /// With these edits. Throws CannotDo where the files cannot be gone on with, as where the map is not on the disk as
    /// it was judged.
    std::map<std::string, RecordFile> with(const RecordEdits& edits);

private:
    std::vector<FileToWrite> new_texts(const RecordEdits& edits);

    const CheckedProject& checked_;
    const Disk& disk_;
};

}  // namespace porttool
