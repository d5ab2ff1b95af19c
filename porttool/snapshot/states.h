// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "porttool/normal/units_by_id.h"
#include "porttool/scan/side.h"
#include "porttool/snapshot/project.h"
#include "porttool/snapshot/side_files.h"

namespace porttool {

/// The units of both sides by id.
using States = BySide<UnitsById>;

/// The ids that the map names.
std::set<std::string> named_ids(const MapFile& map);

/// The states of all units, and of whole files that the map names (`PATH:@file`).
States read_states(const Project& project);

/// The same of files that are known by their facts.
States read_states(const BySide<KnownSide>& files);

/// The same, where `known` has read some files already, under the same pairs: those of `same`, by path, are as they
/// were there.
States read_states(const Project& project, States known, const BySide<std::set<std::string>>& same);

}  // namespace porttool
