// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "porttool/read/glob.h"
#include "porttool/read/lock_file.h"
#include "porttool/read/map_file.h"

namespace porttool {

/// The ports of a project: those that [sides.targets] names, or one without a name.
class TargetSets {
public:
    explicit TargetSets(const MapFile& map);

    /// In the order of the names; {""} where the map has but one port.
    const std::vector<std::string>& names() const { return names_; }

    /// The set of a file of the target's side: the first whose globs match; "" where none does.
    const std::string& of_path(const std::string& path) const;
    const std::string& of_id(const std::string& id) const;

private:
    std::vector<std::string> names_;
    std::vector<std::pair<std::string, std::vector<Glob>>> sets_;
    mutable std::map<std::string, std::string> known_;  ///< by path
};

/// True if a line of the baseline says that its unit has no counterpart in that set.
bool lacks(const LockedUnit& line, const std::string& set);

/// A line of the baseline for a unit without a counterpart in the sets that `missing` names, in the order of `all`.
LockedUnit baseline_line(const std::string& id, const Fingerprints& prints, Side side,
                         const std::vector<std::string>& missing, const std::vector<std::string>& all);

/// Takes a set out of those that a line speaks of. False if none is left.
bool take_out(LockedUnit& line, const std::string& set, const std::vector<std::string>& all);

}  // namespace porttool
