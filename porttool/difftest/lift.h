// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "porttool/difftest/trial.h"

namespace porttool {

/// A function for numbers, held against one for vectors that works on each component: `clamp(x, lo, hi)` against
/// `clamp(v, lo, hi)`. The narrow side as one that takes and gives what the wide one does, by a call a component; none
/// where the wide side gives no vector, or takes what is neither a number nor a vector of as many.
std::optional<BuiltSide> lifted(const BuiltSide& narrow, const Leaves& wide);

}  // namespace porttool
