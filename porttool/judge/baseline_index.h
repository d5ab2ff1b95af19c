// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_map>
#include <vector>

#include "porttool/normal/units_by_id.h"
#include "porttool/read/lock_file.h"
#include "porttool/scan/side.h"

namespace porttool {

/// Finds the line of the baseline that excuses a unit without a counterpart. A line excuses one unit: the one with its
/// id and text, else one with its text, which has moved, else the one with its id, which was edited. So a new overload
/// that takes the id of an old one, and a copy of it, are new all the same. A line whose unit is gone excuses what that
/// became: a unit of its text under other names, of its last name in its file, or of its whole name elsewhere.
class BaselineIndex {
public:
    /// `set`: the port that they lack; "" where there is but one. `units`: those of the side that no pair leads to;
    /// `all`: all of the side, by id. All must outlive it.
    BaselineIndex(const std::vector<LockedUnit>& lines, Side side, const std::string& set,
                  const std::vector<const UnitState*>& units, const UnitsById& all);

    /// The line, or nullptr.
    const LockedUnit* find(const UnitState& unit) const;

private:
    std::unordered_map<const UnitState*, const LockedUnit*> found_;
};

}  // namespace porttool
