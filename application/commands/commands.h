// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "application/console.h"
#include "application/exit_code.h"
#include "application/options.h"

// The subcommands, one file each. They print through the console and answer the program's exit code.

namespace application {

ExitCode run_render(const Options& options, Console& console);
/// `render --frames`: one picture a frame, each there whole or not at all.
ExitCode run_frames(const Options& options, Console& console);
ExitCode run_compare(const Options& options, Console& console);
ExitCode run_bench(const Options& options, Console& console);
ExitCode run_view(const Options& options, Console& console);
ExitCode run_merge(const Options& options, Console& console);
ExitCode run_info(const Options& options, Console& console);

}  // namespace application
