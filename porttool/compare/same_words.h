// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/compare/statement_edit.h"
#include "porttool/scan/side.h"

namespace porttool {

/// True if both edits lost and gained the same statements, or the same words in statements that stand for each other.
///
///                 source                     port
///     before      d = dot(n, l) * k;         d = k * dot(n, l);       written otherwise since ever
///     now         d = dot(n, h) * k;         d = k * dot(n, h);       the same edit: l became h beside `n ,`
///     or now      d = dot(n, h) * k;         e = k * dot(n, h);       another one
///
/// The same words changed elsewhere are another edit: no other statement of the port's old text may be more like the
/// source's than the one that was edited, and where some are as like, only these two may stand for each other where the
/// texts are laid side by side to be as alike as can be.
bool same_words(const StatementEdit& source, const StatementEdit& target);

/// What one side's edit did and the other's did not.
struct MissingStatements {
    std::vector<std::string> sentences;  ///< which statements came or went, and of one that only moved in which block
    BySide<size_t> count = {0, 0};       ///< how many statements that each side lost or gained are told of
};
MissingStatements missing_statements(const StatementEdit& source, const StatementEdit& target);

/// True if all that both sides did was to put some words in the place of others wherever these stood: the same words in
/// the same place of others on both sides, and none is left.
///
///     run(w, table)       run(w, table0, table1)          source
///     go(1, table, 2)     go(1, table0, table1, 2)        port
bool same_replacements(const StatementEdit& source, const StatementEdit& target);

}  // namespace porttool
