// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>

#include "porttool/read/lock_file.h"
#include "porttool/snapshot/states.h"

namespace porttool {

std::string lock_path(const Project& project);

/// A lock whose prints are of today's normal form.
struct RecordedLock {
    LockFile lock;
    std::string written;              ///< as the file has it
    std::map<Print, UnitText> texts;  ///< by print: those that an older lock's prints were made anew from
};

/// Reads portmap.lock; throws CannotDo if it is not there or cannot be used. `today`: the units as they are now.
RecordedLock load_lock(const Project& project, const Disk& disk, const States& today);

/// The same of a lock that was read already; its texts are on that disk.
RecordedLock lock_of_today(const Project& project, const Disk& disk, ReadLock read, const States& today);

/// Waits until no other porttool changes this project's lock. Taken before the lock is read, held until it is written.
/// Throws CannotDo.
std::unique_ptr<WriteGuard> guard_lock(const ProjectChoice& choice, Workplace& place);

/// What is written at once.
struct NewRecord {
    const LockFile& lock;
    const States& states;
    const std::map<Print, UnitText>& texts;  ///< by print, where the states do not have them any more
    const std::string* map_text = nullptr;   ///< the map, where it is new, too
    bool clears = false;                     ///< removes texts that no print stands for
};

/// Writes portmap.lock and, in portmap.base/, the texts behind its prints. A text that is not needed any more
/// stays unless asked otherwise: another branch may have come to need it, and git would merge its removal without a
/// word. Other files in that folder are never removed. What fails leaves all as it was. Throws CannotDo.
void store_lock(const Project& project, const NewRecord& record, Disk& disk);

/// Texts behind a lock that cannot be used.
struct LostTexts {
    std::set<Print> missing;        ///< from portmap.base/
    std::set<Print> damaged;        ///< there, but not what their names say: cut, edited, a link
    std::set<Print> left_out = {};  ///< git has them, and a sparse checkout leaves them out of the work tree
    std::string folder = {};        ///< of the texts, as git is to be told of it
};

/// Which texts of portmap.base/ are missing. Lists the folder, and reads none.
LostTexts missing_texts(const Project& project, const Disk& disk, const LockFile& lock);

/// Which are missing or damaged. Reads them all, some 6 microseconds each; what is more than a GiB, the most that
/// sources may be, counts as damaged.
LostTexts lost_texts(const Project& project, const Disk& disk, const LockFile& lock);

/// What to say of them: a line, or "" for none.
std::string told(const LostTexts& lost);

/// A text from portmap.base/; empty if it is not there, or is not the one that its name says.
NormalText base_text(const Project& project, const Disk& disk, Print print);

}  // namespace porttool
