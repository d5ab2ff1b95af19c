// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/command_table.h"

#include <vector>

#include "application/commands/commands.h"
#include "application/declare_options.h"

namespace application {

std::span<const Command> command_table() {
    static const std::vector<Command> table = {
        {"render", "Render a scene to a picture (.png or .exr)", declare_render, run_render},
        {"compare", "Tell how much the pictures of both cores, or two image files, differ", declare_compare,
         run_compare},
        {"view", "Open a window on both cores", declare_view, run_view},
        {"merge", "Add renders of disjoint sample ranges to the picture of one run", declare_merge, run_merge},
        {"bench", "Count the rays of a scene and time them", declare_bench, run_bench},
        {"info", "List the cores and devices that this machine can use", declare_info, run_info},
    };
    return table;
}

const Command* find_command(const std::string& name) {
    for (const Command& command : command_table()) {
        if (command.name == name) return &command;
    }
    return nullptr;
}

}  // namespace application
