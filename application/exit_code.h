// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace application {

/// What the program answers to the shell.
enum ExitCode : int {
    DONE = 0,           ///< done; for a gate: nothing to act on
    ANSWER_NO = 1,      ///< done, and the answer is no
    FAILED = 2,         ///< could not be done; one or two lines on stderr say why
    INTERRUPTED = 130,  ///< by Ctrl-C; what was there is written whole
    TERMINATED = 143,   ///< by SIGTERM, likewise
    HUNG_UP = 129,      ///< by SIGHUP: its terminal has gone; likewise
};

}  // namespace application
