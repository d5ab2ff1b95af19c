// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "porttool/normal/unit_state.h"
#include "porttool/read/lock_file.h"

namespace porttool {

/// Finds the line of the baseline that excuses a unit without a port. A line excuses one unit: the one with its id and
/// text, else one with its text, which has moved, else the one with its id, which was edited. So a new overload that
/// takes the id of an old one, and a copy of it, are new all the same.
class BaselineIndex {
public:
    BaselineIndex(const std::vector<LockedUnit>& lines, const std::vector<const UnitState*>& units);

    /// The line, or nullptr.
    const LockedUnit* find(const UnitState& unit) const;

private:
    std::map<const UnitState*, const LockedUnit*> found_;
};

}  // namespace porttool
