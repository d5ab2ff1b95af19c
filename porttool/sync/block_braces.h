// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <vector>

#include "porttool/sync/transplant.h"
#include "porttool/sync/unit_words.h"

namespace porttool {

/// A unit in its file, as words and clauses.
struct PlacedUnit {
    const ScannedFile& file;
    const UnitWords& words;
    const std::vector<Clause>& clauses;
};

/// A clause of the target as it will be: one that it has, or one that it gets.
struct ResultClause {
    bool is_new = false;
    size_t clause = 0;               ///< of the source's new text where new, else of the target
    size_t partner = Clause::kNone;  ///< of a head its closing brace in the result, and the other way round
};

/// The clauses of the target once a transplant is made, in order.
std::vector<ResultClause> result_clauses(const Transplant& transplant, const PlacedUnit& source,
                                         const PlacedUnit& target);

/// Which braces are written otherwise than where they come from. In normal form every block has its braces; in a file
/// a block of one statement may do without. Where the edit gives a block of the source its braces, or takes them, so
/// does the port.
///
///     if ( a ) {      target: no brace; gets one, since a second statement comes in
///     x = 1 ;
///     y = 2 ;         new
///     }               target: no brace; gets one
struct BlockBraces {
    std::set<size_t> source_written;  ///< braces of the source's normal form alone that the target gets
    std::set<size_t> source_hidden;   ///< braces that the source has and the target does not get
    std::vector<size_t> opened;       ///< heads of the target that get a brace
    std::vector<size_t> unopened;     ///< heads of the target that lose theirs
    std::vector<size_t> closed;       ///< ends of blocks of the target that get one
    std::vector<size_t> dropped;      ///< ends of blocks of the target that lose it
};

BlockBraces block_braces(const std::vector<ResultClause>& result, const Transplant& transplant,
                         const PlacedUnit& source, const PlacedUnit& target);

}  // namespace porttool
