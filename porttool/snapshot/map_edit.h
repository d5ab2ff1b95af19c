// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What porttool writes into a portmap.toml that a person edits as well.
#pragma once

#include <string>
#include <vector>

#include "porttool/snapshot/project.h"

namespace porttool {

/// Two units that become a pair.
struct NewPair {
    std::string source, target;
    double score = -1;  ///< how sure the matcher was; below 0: a person said so
};

/// The lines of portmap.toml that say so.
std::string pair_text(const NewPair& pair);

/// The text of a map with more pairs: each behind the one before it in the order of ids, so that git merges branches
/// that add different ones; at the end where there are none, or where the map does not write them as we do.
std::string map_with_pairs(const std::string& text, const MapFile& map, const std::vector<NewPair>& pairs);

/// Takes the pairs into the project's map, and returns its text with them; all else stays as it was written. Throws
/// CannotDo where the text cannot be gone on with, as after `pair = [...]`.
std::string add_pairs(Project& project, const std::vector<NewPair>& pairs);

/// Takes a pair out of the project's map, and returns its text without it. Throws CannotDo where the pair does not
/// stand in a [[pair]] of its own.
std::string remove_pair(Project& project, const NewPair& pair);

}  // namespace porttool
