// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "application/console.h"
#include "application/core_session.h"
#include "application/exit_code.h"
#include "application/options.h"
#include "application/output_files.h"
#include "application/stats_report.h"

// Steps that several subcommands take.

namespace application {

/// Says why not and answers the exit code for it; `other_core`: --core may name another.
ExitCode fail(Console& console, const render_system::Status& status, bool other_core = true);

/// Where a team fails, its leader says why.
ExitCode fail_once(Console& console, const render_system::Status& status);

/// What can be known to be wrong before anything is loaded: the place of the statistics, which must not be `output`,
/// and the folder of kernels.
render_system::Status check_files(const Options& options, const std::string& output);

/// What the run writes: `pictures`, which -o names, and the files of the other options.
std::vector<OutputFile> output_files(const Options& options, const std::vector<std::filesystem::path>& pictures);

/// Starts the core that the options ask for; with `auto` one line on stderr says which and why.
render_system::Result<render_system::CoreChoice> start_chosen_core(CoreSession& session, const Options& options,
                                                                   Picture& picture, Console& console);

/// Writes the JSON to the file of `--stats`, if there is one. Where that fails, the message says what of `-o` was
/// `written` before.
render_system::Status write_stats(const Options& options, const Json& stats, const std::string& written = "");

/// JSON as files and stdout have it.
std::string json_text(const Json& json);

/// Puts the result into the file of `-o`, or on stdout where there is none.
ExitCode deliver(const Options& options, Console& console, const std::string& text);

/// Whether `--exposure` or `--tone-map` asks for other levels than those of the radiance itself.
bool changes_colors(const Options& options);

}  // namespace application
