// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>

#include "porttool/compare/unit_state.h"

namespace porttool {

/// A unit that an id of the lock or the map leads to today.
struct Resolved {
    const UnitState* unit = nullptr;
    bool elsewhere = false;  ///< found by its text under another id: renamed or moved
};

/// Finds units of one side. Variants of one name (#2, #3) are told apart by their text, so that their order does not
/// matter; a unit that is gone from its id is recognised by its text where that is long enough to be its own.
class Resolver {
public:
    /// `named`: ids that the map names, which are never taken for a moved unit.
    Resolver(const std::map<std::string, UnitState>& units, std::set<std::string> named);

    /// `prints` may be nullptr where the lock knows nothing of the id.
    Resolved find(const std::string& id, const Fingerprints* prints);
    /// Marks a unit as spoken for.
    void take(const UnitState* unit);
    bool taken(const UnitState& unit) const { return taken_.contains(&unit); }

private:
    const std::map<std::string, UnitState>& units_;
    std::set<std::string> named_;
    std::map<std::string, std::vector<const UnitState*>> variants_;
    std::multimap<std::string, const UnitState*> by_text_;
    std::set<const UnitState*> taken_;
};

}  // namespace porttool
