// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/read/disk.h"

namespace porttool {

/// Waits, half a minute at most, until no other process writes the file, then removes what killed writers left: their
/// temporaries beside it and in the folder `portmap.base`. The guard is a lock of the kernel's (flock(2)) on a file
/// `NAME.busy` beside NAME: it ends with the process that holds it, so that none can be stale.
TakenGuard take_file_guard(const TreePath& path);

}  // namespace porttool
