// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "application/console.h"
#include "application/exit_code.h"
#include "application/options.h"

namespace CLI {
class App;
}

namespace application {

/// One subcommand: what `--help` says of it, how its options are declared, and the function that carries it out.
/// Help, parsing, "did you mean" and dispatch all read the one table, so that none of them goes stale.
struct Command {
    std::string name;
    std::string help;
    void (*declare)(CLI::App&, Options&);
    ExitCode (*run)(const Options&, Console&);
};

std::span<const Command> command_table();

/// The command of that name, or null.
const Command* find_command(const std::string& name);

}  // namespace application
