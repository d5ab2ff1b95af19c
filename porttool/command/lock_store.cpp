// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/lock_store.h"

#include <set>

#include "porttool/scan/scan.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

std::string folder_of_map(const Project& project) {
    return project.map_path.substr(0, project.map_path.find_last_of('/') + 1);
}

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

void write(Disk& disk, const std::string& path, const std::string& bytes) {
    const std::string failure = disk.write(path, bytes);
    if (!failure.empty()) throw CannotDo(terminal_text(path) + ": " + failure);
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

std::string lock_path(const Project& project) { return folder_of_map(project) + "portmap.lock"; }

LockFile load_lock(const Project& project, const Disk& disk) {
    const FileText file = disk.read(lock_path(project), kLargestFile);
    if (!file.error.empty() && disk.exists(lock_path(project)))
        throw CannotDo(terminal_text(lock_path(project)) + " " + file.error +
                       "; restore it from git, or remove it and run: porttool init");
    if (!file.error.empty())
        throw CannotDo("no portmap.lock beside " + terminal_text(project.map_path) +
                       "; record the present state of its pairs with: porttool init");
    ReadLock read = read_lock(file.bytes);
    if (!read.error.empty()) throw CannotDo(read.error);
    return std::move(read.lock);
}

void store_lock(const Project& project, const LockFile& lock, const States& states, Disk& disk) {
    const std::string folder = folder_of_map(project) + "portmap.base";
    std::set<std::string> needed;
    for (const LockedPair& pair : lock.pairs) {
        needed.insert(pair.source_prints.written);
        needed.insert(pair.target_prints.written);
    }
    std::set<std::string> there;
    if (const auto entries = disk.list(folder))
        for (const DirectoryEntry& entry : *entries) there.insert(entry.name);
    for (const auto* side : {&states.source, &states.target})
        for (const auto& [id, state] : *side)
            if (needed.contains(state.prints.written) && there.insert(state.prints.written).second)
                write(disk, join_path(folder, state.prints.written), state.text);
    write(disk, lock_path(project), lock_text(lock));
    for (const std::string& print : there)
        if (!needed.contains(print)) disk.remove(join_path(folder, print));
}

std::string base_text(const Project& project, const Disk& disk, const std::string& print) {
    const FileText file = disk.read(join_path(folder_of_map(project) + "portmap.base", print), kLargestFile);
    return file.error.empty() ? file.bytes : std::string();
}

}  // namespace porttool
