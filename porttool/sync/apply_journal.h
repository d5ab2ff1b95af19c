// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/read/disk.h"
#include "porttool/sync/apply.h"

namespace porttool {

/// A note in the repository's own folder of the files that are being written: a process that is killed outright between
/// two of them cannot say so itself. Outside of git there is none.
class ApplyJournal {
public:
    /// The disk must outlive it. `root`: of the project.
    ApplyJournal(const std::string& root, Disk& disk);

    void begin(const std::vector<WrittenFile>& files);
    void end();

    /// What became of what a process that is no more has left half done.
    struct Interrupted {
        std::string told;          ///< for a user; "" if nothing was left
        bool is_finished = false;  ///< all its files have its text now
    };
    /// Where each file is as it was or has its text, and those that were not written yet have it beside them, the rest
    /// is written. Anything else is told, once. What lies beside the files is removed. A note of files beneath other
    /// roots than these is none of ours: a `.git` may come in an archive.
    Interrupted take_interrupted(const std::vector<std::string>& roots);

private:
    struct Noted {
        TreePath place;
        std::string before, now;  ///< prints
    };
    static std::vector<Noted> noted(const std::vector<std::string>& fields);
    std::string print_now(const TreePath& place) const;
    bool finish(const std::vector<Noted>& files, int process);

    TreePath note_;  ///< of no root outside of git
    Disk& disk_;
};

}  // namespace porttool
