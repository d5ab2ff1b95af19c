// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "porttool/match/candidates.h"
#include "porttool/match/features.h"

namespace porttool {

/// Constants by different names, or of a second port, that paired functions use in one place and that have one value:
///
///     v = depth[i] * gain;      gain = 1.5f
///     v = in[i] * amplify;      amplify = 1.5f
///
/// Where a value is a common one, as 1 or 64, the words around its uses have to be the same. What several constants
/// could be is none. `pairs` are all pairs, those of constants too.
std::vector<UnitPair> find_constants_in_use(const std::vector<ScannedFile>& source_files,
                                            const std::vector<ScannedFile>& target_files,
                                            const std::vector<UnitFeatures>& source,
                                            const std::vector<UnitFeatures>& target,
                                            const std::vector<UnitPair>& pairs);

}  // namespace porttool
