// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>

#include "porttool/judge/resolve.h"
#include "porttool/normal/normal_text.h"
#include "porttool/normal/units_by_id.h"

namespace porttool {

/// Names of units of one side that were renamed. Who calls such a unit calls the same one under both names, and was not
/// edited by that.
class RenamedNames {
public:
    /// Takes a unit that a recorded id leads to today.
    void note(const std::string& id, const Resolved& unit);
    /// Drops what another unit of the side is called today: there the old name means something else.
    void drop_taken(const UnitsById& units);

    /// A text from before in the names of today.
    NormalText updated(NormalText before) const;

private:
    std::map<std::string, std::string, std::less<>> names_;
};

}  // namespace porttool
