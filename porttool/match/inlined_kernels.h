// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "porttool/match/features.h"

namespace porttool {

inline constexpr uint32_t kNoUnit = 0xFFFFFFFFu;

/// A kernel, and the function of the other side that does its work in the place of launching it.
struct InlinedKernel {
    uint32_t source = 0, target = 0;
    float confidence = 0;
};

/// Finds where kernels without a port stand. A function that launches a kernel and is ported by one that launches
/// nothing has the kernel's work in its port, or in what that calls: `main` with its loops is the port of the `main`
/// that launches, and of what it launches. Of these functions the one that holds most of the kernel is taken. `ports`
/// has the target of each source, `owners` the source of each target, or kNoUnit.
std::vector<InlinedKernel> find_inlined_kernels(const std::vector<UnitFeatures>& source,
                                                const std::vector<UnitFeatures>& target,
                                                const std::vector<uint32_t>& ports,
                                                const std::vector<uint32_t>& owners);

}  // namespace porttool
