// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What today's texts of a pair say to the edits of its past.
#pragma once

#include <string>
#include <vector>

#include "porttool/audit/common_texts.h"
#include "porttool/audit/missing_edit.h"
#include "porttool/language/dialect.h"
#include "porttool/scan/side.h"

namespace porttool {

struct PairReading {
    std::vector<MissingEdit> missing;
    std::vector<MissingPlace>
        differs;  ///< what few statements the two sides say otherwise today, with `now` the source's
    std::vector<MissingPlace> slips;  ///< what looks like a slip of one side, as TodaysDifferences has it
    float alike = 0;                  ///< share of the words that stand in statements that both sides have today
};

/// A statement in the common vocabulary, as one text.
std::string statement_key(const WrittenStatement& statement, const Dialect& dialect);

/// Asks of every edit of both sides whether today's other side has it: for each statement of today the oldest text that
/// the other side still has in place of it, statements that it never got, and such that only it still has.
PairReading read_pair(const BySide<SideOfPair>& pair, const Dialect& dialect);

/// What looks like a slip of one side today, whatever the past was: of two functions that are no pair.
PairReading read_slips(const BySide<SideOfPair>& pair, const Dialect& dialect);

}  // namespace porttool
