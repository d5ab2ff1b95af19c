// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

namespace porttool {

/// How a command ended.
struct CommandEnd {
    int exit_code = 0;  ///< 124 where it ran out of time, 128 and the signal's number where one killed it
    double seconds = 0;
    std::string output_tail;  ///< the last lines of what it printed, stdout and stderr as they came
    bool timed_out = false;
};

/// Runs a command line of the user's own by `/bin/sh -c` in a folder, with nothing on its stdin, and without the
/// variables by which git points a hook at a repository. It and all that it started end with the time that it has, with
/// its shell, and where a signal other than SIGKILL ends us. Throws CannotDo if there is no shell to start.
CommandEnd run_bounded(const std::string& command, const std::string& folder, std::chrono::milliseconds limit);

}  // namespace porttool
