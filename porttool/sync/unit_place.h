// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// A unit of the source's file, and what stands for it in the target's.
struct StandsFor {
    const Unit* source = nullptr;
    const Unit* port = nullptr;
};

/// Where a new unit of the source goes in a file of the target.
struct PlaceWanted {
    const ScannedFile& source;
    const Unit& unit;
    const ScannedFile& target;
    const std::vector<StandsFor>& pairs;  ///< of these two files
    const Unit* user = nullptr;           ///< the port of what uses it, if it stands in that file
    const std::set<std::string>& uses;    ///< what it uses of the target, by the last part of names
};

/// Behind the counterpart of the unit before it, or before that of the one after it; what it uses stands above, what
/// uses it below.
struct UnitPlace {
    bool found = false;
    size_t offset = 0;       ///< of the target's scanned text
    size_t blank_lines = 0;  ///< between it and its neighbour
    bool below = false;      ///< it comes after its neighbour
    std::string indent;      ///< that of its neighbour
    std::string failure;
};
UnitPlace place_of_new_unit(const PlaceWanted& wanted);

/// True if a file of the target includes another, as far as the names of files tell.
bool includes(const std::vector<ScannedFile>& files, const ScannedFile& file, const ScannedFile& wanted);

}  // namespace porttool
