// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "porttool/command/commands.h"

namespace porttool {

/// One subcommand: what `--help` says of it, how its options are declared, and what carries it out. Help, parsing, "did
/// you mean" and dispatch all read the one table.
struct Command {
    std::string_view name;
    const char* help;
    void (*declare)(Declare&, Options&);
    Outcome (*run)(const Options&, Workplace&);
};

/// In the order of the help.
std::span<const Command> command_table();

/// The command of that name, or nullptr.
const Command* find_command(std::string_view name);

}  // namespace porttool
