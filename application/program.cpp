// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/program.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "application/cluster/team.h"
#include "application/cluster/team_plan.h"
#include "application/command_line.h"
#include "application/command_table.h"
#include "application/console.h"
#include "application/file_output.h"
#include "render_system/modules.h"

namespace application {
namespace {

ExitCode carry_out(const Invocation& invocation, Console& console) {
    if (invocation.command == nullptr) {
        std::fputs(invocation.text.c_str(), invocation.exit_code == DONE ? stdout : stderr);
        return invocation.exit_code;
    }
    if (const render_system::Status status = render_system::check_module_folders(); !status.ok()) {
        console.error(status.message);
        return FAILED;
    }
    try {
        return invocation.command->run(invocation.options, console);
    } catch (const std::bad_alloc&) {
        console.error("out of memory; give a smaller --size or scene");
    } catch (const std::exception& error) {
        console.error(std::string("internal error: ") + error.what());
    }
    return FAILED;
}

}  // namespace

int run_program(std::span<const std::string> arguments) {
    remove_unfinished_file_on_signals();
    Invocation invocation = parse_command_line(arguments);
    const bool renders = invocation.command != nullptr && invocation.command->name == "render";
    if (team() && !team()->leads()) {
        invocation.options.quiet = true;
        invocation.options.verbose = invocation.options.progress = false;
    }
    const bool is_terminal = isatty(STDERR_FILENO) != 0;
    const bool color = use_color(invocation.options.color, is_terminal, std::getenv("NO_COLOR"));
    Console console(invocation.options, color, is_terminal);
    if (team()) {
        if (const auto same = team()->agree_on(team_plan(invocation)); !same.ok()) {
            if (team()->leads()) console.error(same.message);
            return FAILED;
        }
    }
    // One of a team speaks; the others are heard where they fail.
    if (team() && !team()->leads() && !renders) return invocation.exit_code;
    const ExitCode code = carry_out(invocation, console);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    console.error("cannot write to stdout");
    return FAILED;
}

}  // namespace application
