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

/// The map that a merge gives, written into the text of one side.
struct MergedMap {
    std::string text;
    MapFile map;
    std::vector<NewPair> added;    ///< new on the other side
    std::vector<NewPair> removed;  ///< there before the merge, and taken out by one side
};

/// Keeps what one side added, and leaves out what one took out of the pairs `before`, those that both sides come from.
/// Throws CannotDo where a side cannot be read, or such a pair stands in no [[pair]] of its own.
MergedMap merged_map(const Project& project, const std::string& text, const std::string& other,
                     const std::vector<NewPair>& before);

/// Where the map itself lies, for git: links are followed; seen from the root where it is beneath that.
std::string map_behind_links(const Project& project);

}  // namespace porttool
