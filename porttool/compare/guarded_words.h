// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/compare/meaning.h"

namespace porttool {

/// What the common vocabulary drops and what can change a value all the same: `volatile`, and a number of 64 bits
/// (`1ull << 40`). If one side's edit has more of it than the other's, a sentence that says so; else "".
std::string guarded_difference(const PairTexts& texts);

}  // namespace porttool
