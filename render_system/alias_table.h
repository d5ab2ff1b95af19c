// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "render_system/core_data.h"

namespace render_system {

/// Builds Walker's alias table in linear time and without bias (M. D. Vose, "A linear algorithm for generating random
/// numbers with a given distribution", IEEE Trans. Software Eng. 17(9), 1991). Entry i is chosen with probability
/// weights[i] / sum; if all weights are 0, all entries are equally likely. Weights must be finite and not negative.
std::vector<AliasEntry> build_alias_table(std::span<const double> weights);

}  // namespace render_system
