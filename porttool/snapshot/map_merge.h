// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Two branches that add pairs which are neighbours in portmap.toml add them at one place, which git asks about.
#pragma once

#include <string>
#include <vector>

#include "porttool/snapshot/map_edit.h"

namespace porttool {

/// The text of a map in which git left both sides of a merge, as one of the two would have it.
struct MapSides {
    std::string ours, theirs;
};

/// Takes the two apart. Throws CannotDo where no marks of a merge are in the text, or these are incomplete.
MapSides map_sides(const std::string& name, const std::string& text);

/// One side of a merge with the pairs that only the other has.
struct MergedMap {
    std::string text;
    MapFile map;
    std::vector<NewPair> added;
};

/// Throws CannotDo where a side cannot be read.
MergedMap with_pairs_of(const std::string& name, const std::string& text, const std::string& other);

}  // namespace porttool
