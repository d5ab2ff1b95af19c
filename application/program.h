// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace application {

/// The whole program but for `main`: reads the arguments, carries out the command, answers the exit code. Whatever goes
/// wrong ends here as a line on stderr.
int run_program(std::span<const std::string> arguments);

}  // namespace application
