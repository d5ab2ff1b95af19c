// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/language/language.h"

namespace porttool {

/// What an edit brings in that means different things in the two languages of a pair, one sentence each: `pow` of a
/// negative base, `mod` of negatives and the like. `gained` and `lost` are statements as shown by edit_of(); a call
/// that was there before is not brought in.
std::vector<std::string> hazards_of(const std::vector<std::string>& gained, const std::vector<std::string>& lost,
                                    Language here, Language there);

}  // namespace porttool
