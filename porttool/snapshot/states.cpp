// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/states.h"

#include <set>

#include "porttool/scan/scan.h"
#include "porttool/text/parallel.h"

namespace porttool {
namespace {

void add(UnitsById& states, std::vector<UnitState> of_file) {
    for (UnitState& state : of_file) states.add(std::move(state));
}

void add_states(UnitsById& states, const std::vector<ScannedFile>& files, const std::set<std::string>& named,
                const std::set<std::string>& same) {
    std::vector<std::vector<UnitState>> of_files(files.size());
    in_parallel(files.size(), files.size() >= kFilesWorthThreads, [&](size_t i) {
        const ScannedFile& file = files[i];
        if (!same.contains(file.path))
            of_files[i] = states_of(file, named.contains(unit_id(file, whole_file_unit(file))));
    });
    for (std::vector<UnitState>& of_file : of_files) add(states, std::move(of_file));
}

}  // namespace

std::set<std::string> named_ids(const MapFile& map) {
    std::set<std::string> named;
    for (const MapPair& pair : map.pairs) {
        named.insert(pair.source);
        named.insert(pair.targets.begin(), pair.targets.end());
    }
    return named;
}

States read_states(const BySide<KnownSide>& files) {
    States states;
    for (const Side side : kBothSides)
        for (const auto& file : files[side]) add(states[side], states_of(file));
    return states;
}

States read_states(const Project& project) { return read_states(project, {}, {}); }

States read_states(const Project& project, States known, const BySide<std::set<std::string>>& same) {
    const std::set<std::string> named = named_ids(project.map);
    for (const Side side : kBothSides) {
        known[side].erase_if([&](const UnitState& unit) { return !same[side].contains(unit.file); });
        add_states(known[side], side == Side::Source ? project.source : project.target, named, same[side]);
    }
    return known;
}

}  // namespace porttool
