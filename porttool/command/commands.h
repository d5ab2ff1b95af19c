// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <string>

#include "porttool/command/options.h"
#include "porttool/read/cannot_do.h"
#include "porttool/read/workplace.h"

namespace porttool {

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

/// Throws CannotDo unless `format` is one of `known`.
void require_format(const std::string& format, std::initializer_list<const char*> known);

/// Runs a command line: parses, runs, writes. Returns the exit code.
int run_porttool(int argc, const char* const* argv, Disk& disk, std::ostream& out, std::ostream& err);

}  // namespace porttool
