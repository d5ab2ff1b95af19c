// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "porttool/compare/compare_pair.h"
#include "porttool/compare/meaning.h"
#include "porttool/judge/check_project.h"
#include "porttool/read/lock_lines.h"

namespace porttool {

/// Templates of a file that are classes, and that the port comes to name without arguments more often than before.
std::set<std::string> templates_without_arguments(const ScannedFile& file, const std::vector<std::string>& was,
                                                  const std::vector<std::string>& is);

/// What a pair would be with these texts on its sides. `before`: the texts when it was last in step.
PairComparison compare_now(const JudgedPair& pair, const LockedPair& line, const BySide<NormalText>& before,
                           const NormalText& source, const Fingerprints& source_prints, const NormalText& target,
                           const Fingerprints& target_prints, const Dialect& dialect);

/// The four texts of a pair whose sides were both edited, without what stands before their bodies. Of texts that
/// outlive it.
struct EditedBodies {
    /// `before`: the texts when the pair was last in step.
    EditedBodies(const BySide<NormalText>& before, const NormalText& source, const NormalText& target);

    PairTexts texts() const { return {source_before, source_now, target_before, target_now}; }

    Words source_before, source_now, target_before, target_now;
    bool same_preludes;  ///< what stands before the bodies stayed as it was on both sides
};

/// True if `check` has no more than a note for edits that differ so: what came to both sides is the same, and what each
/// had in its own words is gone, or the same labels joined an arm.
bool is_only_noted(const JudgedPair& pair, const EditedBodies& bodies, const Dialect& dialect);

/// True if the same words came and went on both sides, at the same places, or for the most part and none in a wrong
/// place, in statements that are said in two ways: what `check` only notes as well. `in_place`: no statement came, so
/// that the port's own words stand around all that changed; only then "for the most part" is enough.
bool is_edited_in_same_words(const JudgedPair& pair, const EditedBodies& bodies, const Dialect& dialect, bool in_place);

/// What stands in the way of two edits that are not equivalent, as a reader is told.
std::string what_differs(const PairComparison& found);

/// Names that the port would use where neither it nor its file declares them any more.
std::set<std::string> names_lost(const ScannedFile& file, const std::vector<std::string>& was,
                                 const std::vector<std::string>& is);

/// What a port whose function came to give a value back, or no longer does, still gives back as before; "" for nothing.
std::string gives_back_as_before(const std::vector<std::string>& was, const std::vector<std::string>& is);

/// True if each `#if` of a unit has its `#endif`, and the other way round.
bool ends_its_directives(const std::vector<std::string>& words);

/// A qualifier that stands twice where it stood once, or not at all; "" for none.
std::string doubled_qualifier(const std::vector<std::string>& was, const std::vector<std::string>& is);

/// True if all units but one are as they were.
bool others_stayed(const ScannedFile& before, const ScannedFile& now, const Unit& edited_before);

/// Where a unit of the pair begins; 0 where it is gone.
uint32_t first_line(const JudgedPair& pair, Side side);

}  // namespace porttool
