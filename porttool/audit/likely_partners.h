// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "porttool/scan/side.h"
#include "porttool/snapshot/snapshot.h"

namespace porttool {

/// For functions that have no pair the one of the other side, paired or not, in which most of their rare words stand:
/// what was cut out of it, or is spread over it. `paired`: the ids that some pair names. In order of the ids.
std::vector<BySide<std::string>> likely_partners(const States& states, const BySide<std::set<std::string>>& paired);

}  // namespace porttool
