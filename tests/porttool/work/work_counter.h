// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace porttool::testing {

/// So many times the work, at most, for a text of twice the size.
inline constexpr double kMostGrowth = 2.1;

/// What a piece of code did, in counts that are the same on every run and machine.
struct Work {
    uint64_t steps = 0;      ///< stretches of code without a branch that were gone through
    uint64_t allocated = 0;  ///< bytes asked for, whether given back or not
};

/// All work so far of what is compiled with -fsanitize-coverage=trace-pc; bytes of the whole program.
Work work_so_far();

}  // namespace porttool::testing
