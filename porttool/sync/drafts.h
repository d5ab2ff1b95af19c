// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "porttool/judge/check_project.h"
#include "porttool/sync/pair_record.h"

namespace porttool {

/// A file of a project whose target may lie in another checkout, where a path alone does not name one.
struct ProposedPlace {
    std::string path;           ///< relative to the root of its side
    bool is_elsewhere = false;  ///< beneath `target_root`; else beneath the project's root, whichever side it is of
    auto operator<=>(const ProposedPlace&) const = default;
};

/// A file that proposals write, as it is and as it becomes.
struct ProposedFile {
    std::string before, now;
};

using ProposedFiles = std::map<ProposedPlace, ProposedFile>;

/// A file of the side that is written, as the patches before have left it.
struct Draft {
    std::string bytes, original;
    ScannedFile scanned;
    ProposedPlace place;
    bool is_linked = false;  ///< a link, or behind one: read like any other file, and never written
};

/// What to say of such a file.
inline constexpr const char* kIsLinked = "is a link, or lies behind one";

/// True for a file that a link leads to: what git, and a trial in another work tree, know of it is the link.
bool lies_behind_link(const TreePath& place, const Disk& disk);

const Unit* unit_named(const ScannedFile& file, const std::string& id);

/// The files that the proposals of one run write, one proposal on top of the other.
class Drafts {
public:
    /// Both must outlive it.
    Drafts(const CheckedProject& checked, const Disk& disk) : checked_(checked), disk_(disk) {}

    /// The file as the patches so far have left it. Throws CannotDo if it cannot be read.
    Draft& of(Side side, const ScannedFile& file);
    /// The same of a file that some patch, or a question, has touched; else nullptr.
    const Draft* find(Side side, const std::string& path) const;
    void write(Draft& draft, std::string bytes, ScannedFile scanned);
    /// What the project's own files become; in place of what was said of them before.
    void write_record(std::map<std::string, RecordFile> files) { records_ = std::move(files); }

    /// From here on a proposal is made.
    void begin();
    /// All is as it was there.
    void take_back();
    /// What came since then, as one patch: of the side's files, and of the project's own.
    std::string patch() const;
    std::string record_patch() const;

    /// All files that are other ones now.
    ProposedFiles files() const;

private:
    ProposedPlace place_of(Side side, const std::string& path) const;

    const CheckedProject& checked_;
    const Disk& disk_;
    std::map<ProposedPlace, Draft> drafts_;
    std::map<std::string, RecordFile> records_, records_before_;
    std::map<ProposedPlace, std::string> bytes_before_;  ///< of drafts that were written since begin()
};

}  // namespace porttool
