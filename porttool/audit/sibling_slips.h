// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What was copied for the next component and not changed in all places.
#pragma once

#include <string>
#include <vector>

#include "porttool/audit/lone_slips.h"

namespace porttool {

/// In statements, one behind the other, that say the same for one component, number or letter after another, the word
/// that does not go along, where the word it would be is one that the unit knows:
///
///     lo . x = a . x * s . x ;  lo . y = a . y * s . y ;  lo . z = a . z * s . y ;
///
/// The same of the terms of one sum, where an operator between two may be the odd one, too. Of two such statements
/// nothing is told but where at least four words go along: people divide both by the width.
std::vector<LoneSlip> sibling_slips(const std::vector<std::vector<std::string>>& statements);

}  // namespace porttool
