// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>

namespace porttool {

/// While it lives, the first Ctrl-C or SIGTERM is noted, and wakes who waits for descriptor(), so that a command can
/// end as it likes; a second one ends the program at once. A signal that whoever started us ignores stays ignored. One
/// at a time.
class StopSignal {
public:
    StopSignal();
    ~StopSignal();
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;

    /// Can be read once a signal came.
    int descriptor() const;
    /// The exit code of a program that the signal ends, 130 or 143; 0 as long as none came.
    int exit_code() const;

private:
    struct sigaction interrupt_ {
    }, terminate_{};  ///< as they were before
};

}  // namespace porttool
