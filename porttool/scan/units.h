// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/scan/brackets.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// What find_units read: the units in order of appearance, and the token ranges of everything else it understood.
struct UnitList {
    std::vector<Unit> units;
    std::vector<TokenRange> declarations;
    std::vector<FileVariable> variables;  ///< in order of appearance
};

/// Finds functions, kernels, structs, constants and value macros. Linear time, no recursion, never fails.
UnitList find_units(const LexedText& lexed, const Structure& structure, Language language);

}  // namespace porttool
