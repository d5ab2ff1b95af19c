// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace metrics {

/// Jaccard's distance between two bags of lines: 1 - |a and b| / |a or b|. A line is a number that stands for its text;
/// one that comes twice on one side and once on the other is paired once. It is the code divergence of two
/// platforms (Harrell et al. 2018; Code Base Investigator), but lines are the same where their text is, not where their
/// place is. 0 is alike, 1 has no line in common. Not both may be empty.
double line_divergence(std::vector<uint64_t> a, std::vector<uint64_t> b);

}  // namespace metrics
