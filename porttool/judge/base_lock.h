// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What stands in for the lock where a project is held against a merge base.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <utility>

#include "porttool/read/lock_file.h"
#include "porttool/snapshot/lock_store.h"
#include "porttool/snapshot/snapshot.h"

namespace porttool {

/// The map and the lock as the merge base has them.
struct BaseRecord {
    bool has_map = false;
    MapFile map;
    bool has_lock = false;
    std::optional<LockFile> changed_lock;  ///< where today's is not the same

    const LockFile& lock(const RecordedLock& now) const {
        static const LockFile none;
        return !has_lock ? none : changed_lock ? *changed_lock : now.lock;
    }
};

/// A map or lock there that cannot be used is as none, with a word on `err`: history cannot be mended. `now`: today's
/// lock, which mostly is the same.
BaseRecord base_record(Snapshot& base, const RecordedLock& now, const States& today, std::ostream& err);

/// The units of both sides at the merge base, as if they had been accepted there.
struct BaseLock {
    LockFile lock;
    std::map<Print, UnitText> texts;  ///< by print
    /// Pairs, by their ids, recorded at the merge base, of which one side was gone there already.
    std::set<std::pair<std::string, std::string>> gone_before;
};

/// `now` is the lock in force, `then` what it was at the base: a pair whose line changed since and matches today's
/// units was accepted meanwhile and counts as in step. An id of the map that was not mended when its unit moved leads
/// to what the unit had become at the base, so that edits made until then are not told again; `text_of` gives the text
/// behind a fingerprint of `now`, or an empty one.
BaseLock base_lock(const Snapshot& base, const LockFile& then, const LockFile& now, const States& today,
                   const std::function<NormalText(Print)>& text_of);

}  // namespace porttool
