// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "porttool/snapshot/facts_store.h"
#include "porttool/snapshot/states.h"

namespace porttool {

/// Where a project is looked at.
struct Moment {
    enum class Kind : uint8_t { WorkTree, Index, MergeBase };
    Kind kind = Kind::WorkTree;
    std::string revision = {};  ///< MergeBase: whose merge base with HEAD is meant
};

/// How far a project is read: the normal form of all units takes longer than to scan them.
enum class Depth : uint8_t { Scanned, Normal };

/// The project in a work tree, in the index or in a commit: both sides, scanned, with the states of their units; or,
/// where facts were kept of files, known by these, and scanned when somebody asks `files()`. The map, the lock and the
/// texts that stand there are in `disk()`.
struct Snapshot {
    Project project;  ///< with the map that its sides were read under; without files where these are `known`
    States states;
    Moment at;
    std::string note;               ///< what a user should know of it, or ""
    MemoryDisk git;                 ///< what git gave of it; empty for a work tree
    const Disk* on_disk = nullptr;  ///< of the work tree; not ours
    /// Of a commit or an index, by side: files and folders that cannot be read there, so that what they hold is
    /// unknown.
    BySide<std::set<std::string>> unknown = {};
    /// Of a work tree: the bytes of files whose scanned text is not all of them, for who reads it again.
    BySide<std::map<std::string, std::string>> written = {};
    std::optional<BySide<KnownSide>> known = {};

    FilesOfSide files(Side side) const;
    BySide<FilesOfSide> files() const { return {files(Side::Source), files(Side::Target)}; }
    /// What its lock stands on. An index without a lock goes with that of the work tree.
    const Disk& disk() const;
};

/// Where a project is, with its map, and none of its files.
Project without_files(const Project& project);

/// Where the map stands in the commits of a project, as seen from its root; "" if it is the user's own, elsewhere.
std::string map_in_commits(const Project& project);

/// The map as it stands at a moment. What git does not have is an error as of a disk; so is the user's own map
/// elsewhere. Throws CannotDo.
FileText map_text_at(const Project& project, const Moment& at, const Disk& on_disk);

/// The map as it stands in a snapshot of a commit or an index, or why there is none.
FileText map_text_of(const Snapshot& snapshot);

/// The ONE way to read a project. Both sides are read under its map as it is in `project`, whose files are read anew.
/// In a work tree each glob must match something, in an index each side, and in both no file with a pair may hold the
/// marks of a merge that is not finished. Of another checkout git is asked for the same revision, or for its HEAD.
/// Throws CannotDo.
Snapshot read_snapshot(Project project, const Moment& at, const Disk& on_disk, Depth depth = Depth::Normal);

/// The same where facts are kept of files, and used if the sides are large enough for that.
Snapshot read_snapshot(Project project, const Moment& at, const Disk& on_disk, FactsStore& facts);

/// The same of a work tree that was read before: what stands as it stood is not scanned again. Throws CannotDo.
Snapshot read_snapshot_again(Project project, Snapshot last, const Disk& on_disk);

/// The same of a commit, beside a snapshot of another moment under the same pairs: what is the same text there is not
/// scanned again. `facts`: what is kept of files where `known` knows its own by that. `see_files` gets it while it has
/// files and no states of their units yet, which take much room: for who scans whole files.
Snapshot read_snapshot_beside(const Snapshot& known, const Moment& at, const Disk& on_disk, FactsStore* facts,
                              const std::function<void(const Snapshot&)>& see_files);

/// Scans files that are known by their facts, for who wants all of `project.source` and `project.target`.
void scan_known_files(Snapshot& snapshot);

/// Adds to a snapshot of a commit the texts behind its lock, which are many and mostly not needed. Throws CannotDo.
void read_base_texts(Snapshot& snapshot);

}  // namespace porttool
