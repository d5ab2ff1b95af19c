// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "porttool/normal/units_by_id.h"
#include "porttool/scan/scan.h"

namespace porttool {

inline constexpr size_t kTokensOfOwnText = 12;  ///< so many make a text a unit's own, whatever its names

/// A unit that an id of the lock or the map leads to today.
struct Resolved {
    const UnitState* unit = nullptr;
    bool elsewhere = false;  ///< found under another id: renamed or moved
};

/// An id that the map names, with what the lock knows of it (nullptr: nothing).
struct NamedUnit {
    std::string id;
    const Fingerprints* prints = nullptr;
};

/// Finds the units of one side that a map names. Variants of one name (#2, #3) are told apart by their text, then their
/// signature, so that their order does not matter. A unit that is gone from its id is recognised by its text where that
/// is long enough to be its own, by its name where other units of its file went to the same new file, and by its name
/// or its file where enough of its text is left: it was edited on the way. Near linear in the number of units.
class Resolver {
public:
    /// `base_text` gives the text behind a fingerprint, or an empty one.
    Resolver(const UnitsById& units, const std::vector<NamedUnit>& named,
             const std::function<NormalText(Print)>& base_text);

    Resolved find(const std::string& id) const;
    /// True for a unit that a named id leads to.
    bool taken(const UnitState& unit) const { return taken_.contains(&unit); }

private:
    using Names = std::vector<const NamedUnit*>;

    void settle_variants(const Names& names, const std::vector<const UnitState*>& variants);
    void follow_texts(const Names& gone);
    void follow_files(const Names& gone);
    void follow_likeness(const Names& gone);
    void give(const std::string& id, const UnitState& unit, bool elsewhere);
    bool is_free(const UnitState& unit) const { return !taken(unit) && !named_.contains(unit.id); }

    const UnitsById& units_;
    const std::function<NormalText(Print)>& base_text_;
    std::unordered_set<std::string> named_;
    std::unordered_map<std::string, Resolved> found_;
    std::unordered_set<const UnitState*> taken_;
};

}  // namespace porttool
