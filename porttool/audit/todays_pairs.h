// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/snapshot/snapshot.h"

namespace porttool {

struct TodaysPair {
    BySide<std::string> id;
    double score = 1;        ///< of the matcher
    bool confirmed = false;  ///< a map names it
    bool stray = false;      ///< no pair of the matcher's: an edit of one unit has its text from before in the other
};

/// Both sides as they are in the work tree, and which unit is the port of which.
struct TodaysPairs {
    Snapshot snapshot;
    std::vector<TodaysPair> pairs;  ///< both units are there

    const UnitState& unit(const TodaysPair& pair, Side side) const { return snapshot.states[side].at(pair.id[side]); }
};

/// True where one of two units calls the other by its name: then it is its caller, and no port of it.
bool one_calls_the_other(const UnitState& a, const UnitState& b);

/// Takes the pairs of the map; where it names none, or where there is no map, those that the matcher finds. Throws
/// CannotDo, also where nothing says which files the sides are.
TodaysPairs todays_pairs(const ProjectChoice& choice, Workplace& place);

}  // namespace porttool
