// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "porttool/difftest/definitions.h"

namespace porttool {

/// A definition that a function needs, without the members of a class that nobody asks for.
struct Piece {
    const Definition* definition = nullptr;
    std::vector<TokenRange> left_out;
    std::set<std::string, std::less<>> words;  ///< every identifier in it
};

/// What must stand before a function so that it compiles by itself: what it names, what that names, and so on.
struct Closure {
    std::vector<Piece> pieces;                 ///< each after those that it names
    std::set<std::string, std::less<>> words;  ///< every identifier of the function itself
    std::string missing;                       ///< what cannot be brought along: "binding NAME"; "" if all can
};

/// What a run can bring along beyond texts: functions whose body is not looked at, since others stand in for them, and
/// variables of plain data that are inputs.
struct Supplied {
    std::set<const Definition*> functions;
    std::set<std::string, std::less<>> variables, arrays;  ///< of one value; of many
};

/// Follows the names in the text of a function.
Closure closure_of(const Definition& function, const Definitions& definitions, const Supplied& supplied);

}  // namespace porttool
