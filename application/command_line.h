// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "application/exit_code.h"
#include "application/options.h"

namespace application {

struct Command;

/// What the arguments of the program ask for: a command to carry out, or (command null) a text to print and an exit
/// code: help and version go to stdout with DONE, a usage error to stderr with FAILED.
struct Invocation {
    const Command* command = nullptr;
    Options options;
    std::string text;
    ExitCode exit_code = DONE;
};

/// Reads the arguments (without the program's name). Pure: looks neither at the environment nor at files.
Invocation parse_command_line(std::span<const std::string> arguments);

}  // namespace application
