// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>

#include "porttool/command/options.h"
#include "porttool/read/disk.h"

namespace porttool {

/// Runs a command line: parses, runs, writes. Returns the exit code.
int run_porttool(int argc, const char* const* argv, Disk& disk, std::ostream& out, std::ostream& err);

/// Runs one that was parsed before.
int run_porttool(const ParsedOptions& parsed, Disk& disk, std::ostream& out, std::ostream& err);

}  // namespace porttool
