// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <stdexcept>
#include <string>

#include "porttool/command/options.h"
#include "porttool/read/disk.h"

namespace porttool {

/// What cannot be done, with its remedy: one or two lines, exit code 2.
struct CannotDo : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Where a command works and writes.
struct Workplace {
    Disk& disk;
    std::ostream& err;
};

/// The outcome of a command: what goes to stdout or to `-o`, and the exit code.
struct Outcome {
    std::string text;
    int exit_code = 0;
};

Outcome scan_command(const Options& options, Workplace& place);
Outcome map_command(const Options& options, Workplace& place);
Outcome init_command(const Options& options, Workplace& place);
Outcome check_command(const Options& options, Workplace& place);
Outcome accept_command(const Options& options, Workplace& place);
Outcome defer_command(const Options& options, Workplace& place);
Outcome ignore_command(const Options& options, Workplace& place);
Outcome explain_command(const Options& options, Workplace& place);
Outcome effort_command(const Options& options, Workplace& place);
Outcome history_command(const Options& options, Workplace& place);
Outcome compare_command(const Options& options, Workplace& place);
Outcome report_command(const Options& options, Workplace& place);

/// The root folder: the nearest one upwards with a portmap.toml, else that of the git work tree, else `directory`.
std::string find_root(const Disk& disk, const std::string& directory);

/// Throws CannotDo unless `format` is one of `known`.
void require_format(const std::string& format, std::initializer_list<const char*> known);

/// Runs a command line: parses, runs, writes. Returns the exit code.
int run_porttool(int argc, const char* const* argv, Disk& disk, std::ostream& out, std::ostream& err);

}  // namespace porttool
