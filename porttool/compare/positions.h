// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/compare/statement_edit.h"

namespace porttool {

/// Where two edits did the same at different places.
struct PositionDifferences {
    std::vector<std::string> sentences;
    bool is_sure = false;  ///< so even where much else is said in words of one side alone
};

/// Sentences on what the two edits lost or gained at different positions; none if the positions are the same. The
/// statements that the two sides share tell one position from another, closing braces among them: the k-th statement
/// lost or gained stands after as many of them on each side. So do, between these, loops, branches and statements of
/// the same names that each side spells in its own way, where both sides have as many.
///
///     source now          port now            shared before both edits: if (a > 0), a = b, }, return a
///     if (a > 0) {        if (a > 0) {
///         a = b;              a = b;          `a *= 2` stands after two of them in the source,
///         a *= 2;         }                   after three in the port:
///     }                   a *= 2;             the same statement, and another program
///     return a;           return a;
PositionDifferences other_positions(const StatementEdit& source, const StatementEdit& target);

}  // namespace porttool
