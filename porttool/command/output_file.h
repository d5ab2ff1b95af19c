// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/command/options.h"
#include "porttool/read/disk.h"

namespace porttool {

/// Refuses a file that an option names as output. `option`: as the user wrote it, "-o x.json". `path`: where that is.
/// Throws CannotDo where its folder is not there, so that a slip of the pen makes no tree of folders, and where it is
/// behind a link that leads out of the project, and where it is what the command reads: a source of either side, the
/// map, the lock and the texts behind it, a path on the command line.
void require_output(const Options& options, const std::string& option, const std::string& path, Disk& disk);

}  // namespace porttool
