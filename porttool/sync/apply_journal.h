// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/read/disk.h"

namespace porttool {

/// A note in the repository's own folder of the files that are being written: a process that is killed outright between
/// two of them cannot say so itself. Outside of git there is none.
class ApplyJournal {
public:
    /// The disk must outlive it. `root`: of the project.
    ApplyJournal(const std::string& root, Disk& disk);

    void begin(const std::vector<TreePath>& files);
    void end();

    /// What a process that is no more has left half done, for a user; "" if nothing. Its temporaries are removed, and
    /// it is told once.
    std::string take_interrupted();

private:
    std::string path_;  ///< "" outside of git
    Disk& disk_;
};

}  // namespace porttool
