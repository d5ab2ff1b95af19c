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

/// What the edits of both sides bring in as one, but not as exactly: `exp` here and `native_exp` there. The first
/// letters of the sentence name the source's.
std::vector<std::string> precision_hazards(const std::vector<std::string>& source_gained,
                                           const std::vector<std::string>& target_gained);

}  // namespace porttool
