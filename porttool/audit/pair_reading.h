// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What today's texts of a pair say to the edits of its past.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "porttool/audit/essence.h"
#include "porttool/audit/lineage.h"
#include "porttool/language/dialect.h"
#include "porttool/normal/unit_state.h"
#include "porttool/scan/side.h"

namespace porttool {

/// A place in which the other side does not have what an edit did.
struct MissingPlace {
    enum class Kind : uint8_t { Replaced, Added, Removed };
    Kind kind = Kind::Replaced;
    WrittenStatement before, now;  ///< before the edit, and today; one is "" where a statement came or went
    WrittenStatement there;        ///< the statement of the other side that says what was before; "" for none
    float strength = 0;            ///< how sure it is that the other side lacks it and should not, 0 to 1
    bool constants_only = false;   ///< nothing but numbers changed
};

/// What one commit did to one side of a pair and the other side lacks.
struct MissingEdit {
    Side side = Side::Source;  ///< that was edited
    uint32_t commit = 0;       ///< by its place in the walk
    std::vector<MissingPlace> places;
    bool both = false;   ///< the commit edited the other side, too
    bool since = false;  ///< the other side was edited later
    size_t size = 0;     ///< places of the unit that the commit edited, here or not
};

/// A side of a pair: its unit as it is today, with what is known of its past.
struct SideOfPair {
    const UnitState* unit = nullptr;
    const UnitLineage* lineage = nullptr;
    const std::set<std::string>* elsewhere = nullptr;  ///< the statements of its file, as statement_key() has them
    const std::vector<std::vector<std::string>>* file_statements = nullptr;  ///< the same as essence_of() has them
    const WordsOfSide* file_words = nullptr;                                 ///< those that its file uses
    const UsesOnSide* uses = nullptr;                                        ///< of words on the whole side
};

struct PairReading {
    std::vector<MissingEdit> missing;
    std::vector<MissingPlace>
        differs;      ///< what few statements the two sides say otherwise today, with `now` the source's
    float alike = 0;  ///< share of the words that stand in statements that both sides have today
};

/// A statement in the common vocabulary, as one text.
std::string statement_key(const WrittenStatement& statement, const Dialect& dialect);

/// Asks of every edit of both sides whether today's other side has it: for each statement of today the oldest text that
/// the other side still has in place of it, statements that it never got, and such that only it still has.
PairReading read_pair(const BySide<SideOfPair>& pair, const Dialect& dialect);

}  // namespace porttool
