// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "porttool/sync/transplant.h"

namespace porttool {

/// Takes back what would leave names without a declaration, or with two: removals of statements that name them; where
/// there are none statements that come in and name them, changes of statements that do before or after, and what uses
/// names that came with these alone. A patch of a part would not compile with half of it. True if anything was taken
/// back; nothing is where a block would keep one of its ends.
bool withdraw(std::set<std::string> names, const AlignedText& now, const AlignedText& target, Transplant& found);

}  // namespace porttool
