// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/states.h"

#include <set>
#include <utility>
#include <vector>

#include "porttool/scan/scan.h"
#include "porttool/text/parallel.h"

namespace porttool {
namespace {

void add_states(UnitsById& states, const std::vector<ScannedFile>& files, const std::set<std::string>& named,
                const std::set<std::string>& same) {
    const auto visit_file = [&](const ScannedFile& file, const auto& visit) {
        if (!same.contains(file.path)) visit_states(file, named.contains(unit_id(file, whole_file_unit(file))), visit);
    };
    const auto add = [&](UnitState state) { states.add(std::move(state)); };
    if (files.size() < kFilesWorthThreads) {  // one of them may be as large as many, and its units stand here once
        for (const ScannedFile& file : files) visit_file(file, add);
        return;
    }
    std::vector<std::vector<UnitState>> of_files(files.size());
    in_parallel(files.size(), true, [&](size_t i) {
        visit_file(files[i], [&](UnitState state) { of_files[i].push_back(std::move(state)); });
    });
    for (std::vector<UnitState>& of_file : of_files)
        for (UnitState& state : std::exchange(of_file, {})) add(std::move(state));
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
        for (const auto& file : files[side]) add_states(file, states[side]);
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
