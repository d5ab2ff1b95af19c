// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "porttool/judge/judgement.h"
#include "porttool/judge/new_words.h"
#include "porttool/read/lock_file.h"
#include "porttool/read/map_file.h"
#include "porttool/read/source_files.h"
#include "porttool/snapshot/side_files.h"

namespace porttool {

/// A comment in the code that settles findings of one rule in its unit.
struct PlacedSuppression {
    std::string file;
    Suppression comment;
};

/// Says of a function whose edit is semantic that it compiles to the same code as `before`, its earlier text; "" if
/// not.
using SameCode = std::function<std::string(const UnitState& unit, Side side, const NormalText& before)>;

/// Everything that a judgement rests on.
struct Case {
    const MapFile& map;
    const LockFile& lock;
    const UnitsById& source;
    const UnitsById& target;
    const std::vector<SkippedFile>& skipped;
    std::function<NormalText(Print)> base_text;        ///< the text of a print, or an empty one
    std::string today;                                 ///< YYYY-MM-DD
    std::vector<PlacedSuppression> suppressions = {};  ///< of both sides
    SameCode same_code = {};                           ///< if compilers are to be asked
    /// The files of both sides, where counterparts of new units are to be looked for.
    std::optional<BySide<FilesOfSide>> files = {};
    /// The lock as it stands in the project, where there is one: a pair without a line in it was never recorded.
    const LockFile* in_project = nullptr;
    const RunEvidence* evidence = nullptr;  ///< where programs ran
    /// With a merge base: pairs, by their ids, of which one side was gone there already.
    const std::set<std::pair<std::string, std::string>>* gone_before = nullptr;
    BySide<const UnitsById*> at_base = {};        ///< with a merge base: the units there
    const BySide<NewWords>* new_words = nullptr;  ///< ... and what is said of words since, outside of units

    const UnitsById& units(Side side) const { return side == Side::Source ? source : target; }
};

/// Holds today's units against the lock. Reads nothing but the case.
Judgement judge(const Case& facts);

}  // namespace porttool
