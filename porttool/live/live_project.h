// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/judge/check_project.h"
#include "porttool/read/file_watch.h"
#include "porttool/read/live_disk.h"

namespace porttool {

/// A project that is judged again whenever something changed that its judgement rests on. The judgement is that of
/// `check`; only files that changed are scanned again.
class LiveProject {
public:
    /// `disk` must outlive it.
    LiveProject(CheckChoice choice, Disk& disk) : choice_(std::move(choice)), disk_(disk) {}

    /// Judges the project as it stands. Throws CannotDo; what is wrong is watched too, so that it can be tried again.
    const CheckedProject& look();
    /// What the last look gave; empty after one that threw.
    const CheckedProject& last() const { return project_; }
    /// What the last look said to the user, line by line.
    const std::string& said() const { return said_; }

    const CheckChoice& choice() const { return choice_; }
    LiveDisk& disk() { return disk_; }
    FileWatch& watch() { return watch_; }

private:
    CheckChoice choice_;
    LiveDisk disk_;
    FileWatch watch_;
    CheckedProject project_;
    std::string said_;
};

}  // namespace porttool
