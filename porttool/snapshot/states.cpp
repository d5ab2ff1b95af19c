// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/states.h"

#include <set>

#include "porttool/scan/scan.h"

namespace porttool {
namespace {

void add_states(std::map<std::string, UnitState>& states, const std::vector<ScannedFile>& files,
                const std::set<std::string>& named) {
    for (const ScannedFile& file : files) {
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

States read_states(const Project& project) {
    std::set<std::string> named;
    for (const MapPair& pair : project.map.pairs) {
        named.insert(pair.source);
        named.insert(pair.targets.begin(), pair.targets.end());
    }
    States states;
    add_states(states.source, project.source, named);
    add_states(states.target, project.target, named);
    return states;
}

}  // namespace porttool
