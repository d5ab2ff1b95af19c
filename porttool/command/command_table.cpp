// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/command_table.h"

#include <algorithm>
#include <array>

namespace porttool {

std::span<const Command> command_table() {
    static constexpr std::array kTable = {
        Command{"scan", "List the units of files and folders", declare_scan, run_scan},
        Command{"map", "Pair source units with target units", declare_map, run_map},
        Command{"init", "Write a first portmap.toml and portmap.lock", declare_init, run_init},
        Command{"check", "Find what changed on one side only, or differently on both", declare_check, run_check},
        Command{"watch", "Print findings as files are saved", declare_watch, run_watch},
        Command{"lsp", "Serve an editor: the Language Server Protocol on stdin and stdout", declare_lsp, run_lsp},
        Command{"accept", "Record that a pair is in step now", declare_accept, run_accept},
        Command{"defer", "Postpone a finding", declare_defer, run_defer},
        Command{"ignore", "Settle a finding for good", declare_ignore, run_ignore},
        Command{"sync", "Propose the port of edits that one side alone has", declare_sync, run_sync},
        Command{"difftest", "Run both sides of pairs on the same inputs", declare_difftest, run_difftest},
        Command{"audit", "List edits of the past that never reached the other side", declare_audit, run_audit},
        Command{"review", "Walk through doubtful pairs and unwatched units", declare_review, run_review},
        Command{"compare", "Measure how much two files or two units share", declare_compare, run_compare},
        Command{"explain", "Show why a finding stands, or what a rule means", declare_explain, run_explain},
        Command{"effort", "Tell what porting a range of commits cost", declare_effort, run_effort},
        Command{"history", "Show metrics and drift debt over the git history", declare_history, run_history},
        Command{"report", "Report what is shared, what drifted, and what porting costs", declare_report, run_report},
    };
    return kTable;
}

const Command* find_command(std::string_view name) {
    const auto table = command_table();
    const auto found = std::find_if(table.begin(), table.end(), [&](const Command& one) { return one.name == name; });
    return found == table.end() ? nullptr : &*found;
}

}  // namespace porttool
