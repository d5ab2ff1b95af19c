// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "application/exit_code.h"

namespace application {

/// While one of these lives, the first Ctrl-C (SIGINT), SIGTERM or SIGHUP does not end the program but is kept here, so
/// that what has been done can be written; a second one ends it at once, as any does without this, but for SIGHUP,
/// which comes by itself. A signal that the caller has ignored, as nohup does with SIGHUP, stays ignored. One at a
/// time.
class KeptInterrupt {
public:
    KeptInterrupt();
    ~KeptInterrupt();
    KeptInterrupt(const KeptInterrupt&) = delete;
    KeptInterrupt& operator=(const KeptInterrupt&) = delete;

    /// The number of the signal that came, or 0.
    int signal() const;
};

/// What a user calls one that is kept.
const char* name_of_signal(int number);

/// What the program answers to the shell after one that is kept.
ExitCode exit_code_of_signal(int number);

}  // namespace application
