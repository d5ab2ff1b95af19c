// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/judge/finding_list.h"

namespace porttool {

/// Groups of findings on edits of one side that are one sweep through many units: nearly all words that came into each
/// for good, or went, came into several of them, or went there, too. Each unit has its own statements for it:
///
///     - # ifdef GROUP_0  y += luma(r[0])  # endif ...         - # ifdef GROUP_0  clamp_to(r[0], lo, hi)  # endif ...
///     + for (uint i = 0; i < film->groups; ++ i) ...          + for (uint i = 0; i < film->groups; ++ i) ...
///
/// A number or an operator that only one of them has is no sweep's: such an edit stands for itself. The longest comes
/// first in its group.
std::vector<std::vector<Finding*>> sweeps(const std::vector<Finding*>& edits);

}  // namespace porttool
