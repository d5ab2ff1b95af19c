// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/normal/units_by_id.h"
#include "porttool/snapshot/side_files.h"

namespace porttool {

/// The units of one side, by how they stand to the other.
struct SideUnits {
    const UnitsById& all;
    const std::set<const UnitState*>& lone;         ///< that no pair leads to
    const std::set<const UnitState*>& fresh;        ///< of these, new
    const std::vector<const UnitState*>& unported;  ///< of these, without a counterpart
    const FilesOfSide* files;                       ///< of the side, if they are there
    /// Whether the edit of a watched unit tells of a new unit that bears a word of its text. It does not where it is
    /// only a note, or where the word was there before.
    std::function<bool(const UnitState& user, std::string_view word)> tells_of;
    /// What is said of a unit whose counterpart may well hold what a new kernel does that the unit launches: its own
    /// finding asks for the look at both. "" where it does not.
    std::function<std::string(const UnitState& user)> answers_for_kernels;
};

/// New units without a counterpart whose lack is no news of its own, with the clause that says why: what uses them is
/// watched, and tells of the edit that brought them; or has no port itself; or most of what stands beside them
/// has none; or they launch kernels, which is nobody's port. A kernel is news but where what launches it answers for
/// it; so are what nothing uses by name, a macro that redefines a word of the language, and what gives another meaning
/// to a name that a watched unit used before: what uses it was not edited.
///
///     float fresnel(float c) {...}        new, used by shade() alone: "shade.cu:shade uses it, which is watched"
std::map<const UnitState*, std::string> told_with_others(const SideUnits& units);

}  // namespace porttool
