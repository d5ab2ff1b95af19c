// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/states.h"

#include <set>

#include "porttool/scan/scan.h"

namespace porttool {
namespace {

void add_states(std::map<std::string, UnitState>& states, const std::vector<ScannedFile>& files,
                const std::set<std::string>& named, const std::set<std::string>& same) {
    for (const ScannedFile& file : files) {
        if (same.contains(file.path)) continue;
        for (const Unit& unit : file.units) {
            UnitState state = unit_state(file, unit);
            states.emplace(state.id, std::move(state));
        }
        const Unit whole = whole_file_unit(file);
        if (file.units.empty() || named.contains(unit_id(file, whole))) {
            UnitState state = unit_state(file, whole);
            states.emplace(state.id, std::move(state));
        }
    }
}

}  // namespace

States read_states(const Project& project) { return read_states(project, {}, {}); }

States read_states(const Project& project, States known, const BySide<std::set<std::string>>& same) {
    std::set<std::string> named;
    for (const MapPair& pair : project.map.pairs) {
        named.insert(pair.source);
        named.insert(pair.targets.begin(), pair.targets.end());
    }
    for (const Side side : kBothSides) {
        std::erase_if(known[side], [&](const auto& entry) { return !same[side].contains(entry.second.file); });
        add_states(known[side], side == Side::Source ? project.source : project.target, named, same[side]);
    }
    return known;
}

}  // namespace porttool
