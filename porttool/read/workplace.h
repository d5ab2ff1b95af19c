// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <string>

#include "porttool/read/disk.h"

namespace porttool {

/// Where a command reads and writes, and where it says what a user should know.
struct Workplace {
    Disk& disk;
    std::ostream& err;
    std::ostream* out = nullptr;  ///< stdout, for a command whose results come while it runs
};

}  // namespace porttool
