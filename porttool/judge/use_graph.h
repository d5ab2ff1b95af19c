// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "porttool/normal/units_by_id.h"

namespace porttool {

/// Which unit of one side uses which, by the names that stand in it. A name means the units of its own file that bear
/// it, else all of the side that do: too many rather than too few. Takes time and memory with the size of the texts.
class UseGraph {
public:
    /// `units` must outlive it.
    explicit UseGraph(const UnitsById& units);

    /// A unit with a number of the caller's.
    struct Marked {
        const UnitState* unit;
        size_t mark;
    };
    enum class Along : uint8_t {
        Uses,   ///< from a unit to what it uses
        Users,  ///< from a unit to what uses it
    };

    /// For each unit that is reached, the mark of the start that is nearest; of several as near, of the first.
    std::map<const UnitState*, size_t> reached(const std::vector<Marked>& starts, Along along) const;

    /// The units of a file, or of all files of that stem.
    std::vector<const UnitState*> units_of_file(const std::string& path) const;
    std::vector<const UnitState*> units_of_stem(const std::string& stem) const;

private:
    /// Units come first, then names.
    std::vector<const UnitState*> units_;
    std::vector<std::vector<uint32_t>> uses_, users_;
    std::map<std::string, std::vector<const UnitState*>> by_file_;
};

}  // namespace porttool
