// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "porttool/match/candidates.h"
#include "porttool/match/features.h"

namespace porttool {

/// Functions that are left without a port, because names tell too little, and what ports them all the same:
///
///   - one that is written like it as nothing else is on either side, where what they call, numbers of three digits
///     (`0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z`), or some words of their names say so, too;
///   - one that holds several of a file: `switch (op) { case RELU: ...` of `relu`, `gelu` and `silu`, or `softmax` of
///     `softmax_max`, `softmax_sum` and `softmax_div`;
///   - one that is at home where a kernel is and holds that and more: `run` of `ADD-Seq.cpp` and the kernels of
///     `ADD-Cuda.cu`.
///
/// `ports` has the target of each source, `owners` the source of each target, or kNoUnit.
std::vector<UnitPair> find_left_over(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target,
                                     const TermNumbers& terms, const std::vector<std::vector<Candidate>>& candidates,
                                     const std::vector<uint32_t>& ports, const std::vector<uint32_t>& owners);

}  // namespace porttool
