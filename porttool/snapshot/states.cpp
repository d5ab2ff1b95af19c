// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/states.h"

#include <set>

#include "porttool/scan/scan.h"
#include "porttool/text/parallel.h"

namespace porttool {
namespace {

void add_states(std::map<std::string, UnitState>& states, const std::vector<ScannedFile>& files,
                const std::set<std::string>& named, const std::set<std::string>& same) {
    std::vector<std::vector<UnitState>> of_files(files.size());
    in_parallel(files.size(), files.size() >= kFilesWorthThreads, [&](size_t i) {
        const ScannedFile& file = files[i];
        if (same.contains(file.path)) return;
        for (const Unit& unit : file.units) of_files[i].push_back(unit_state(file, unit));
        const Unit whole = whole_file_unit(file);
        if (file.units.empty() || named.contains(unit_id(file, whole))) of_files[i].push_back(unit_state(file, whole));
    });
    for (std::vector<UnitState>& of_file : of_files)
        for (UnitState& state : of_file) {
            std::string id = state.id;
            states.emplace(std::move(id), std::move(state));
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
