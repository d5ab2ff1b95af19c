// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// The first tokens of locals that a function declares with a value, never changes, and hands to nobody who could.
/// With `is_const` those that say so.
std::vector<uint32_t> constant_locals(const ScannedFile& file, const Unit& unit, bool is_const);

/// True if a file declares such locals `const` where the other does not.
bool adds_const(const ScannedFile& source, const ScannedFile& target);

}  // namespace porttool
