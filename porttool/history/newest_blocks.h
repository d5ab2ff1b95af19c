// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/history/history.h"
#include "porttool/snapshot/past.h"

namespace porttool {

/// The blocks of the newest commit as `report` has them in a clean work tree, with what their lines are and where they
/// stand; then both sides as a whole. Costs as much as a report. Nothing where the commit's lock
/// cannot be used, which is no matter of the figures.
std::vector<BlockReport> newest_blocks(const Past& past, const History& history, const Disk& on_disk);

}  // namespace porttool
