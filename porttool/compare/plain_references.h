// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"
#include "porttool/scan/side.h"

namespace porttool {

/// How values are handed over, in one manner: a reference to a constant is a value, or stays where the other side has a
/// pointer; `out` and `inout` are references. Texts have numbers for locals.
///
///     const vec3 & %1          vec3 %1
///     inout float %2           float & %2
BySide<Words> with_plain_references(const BySide<Words>& texts);

/// False if a parameter is written back by one side's function, by a reference or a pointer, and is a copy in the
/// other's. Texts as with_plain_references() gives them.
bool are_handed_alike(const BySide<Words>& plain);

}  // namespace porttool
