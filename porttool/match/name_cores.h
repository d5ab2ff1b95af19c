// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/match/features.h"

namespace porttool {

/// Fills in what the units' names are about (UnitFeatures::core): their words without those that tell how, without what
/// stands in most names of a side, and without what one side alone has in front of names that the other side has as
/// well (`rule_mangle_reverse` where there is `mangle_reverse`).
void read_cores(std::vector<UnitFeatures>& source, std::vector<UnitFeatures>& target, const TermNumbers& terms);

}  // namespace porttool
