// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/compare/statement_edit.h"

namespace porttool {

/// Sentences on what the two edits lost or gained at different positions; none if the positions are the same. The
/// statements that the two sides share tell one position from another, closing braces among them: the k-th statement
/// lost or gained stands after as many of them on each side.
///
///     source now          port now            shared before both edits: if (a > 0), a = b, }, return a
///     if (a > 0) {        if (a > 0) {
///         a = b;              a = b;          `a *= 2` stands after two of them in the source,
///         a *= 2;         }                   after three in the port:
///     }                   a *= 2;             the same statement, and another program
///     return a;           return a;
std::vector<std::string> other_positions(const StatementEdit& source, const StatementEdit& target);

}  // namespace porttool
