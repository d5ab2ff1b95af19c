// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/base_lock.h"

#include <algorithm>
#include <set>

#include "porttool/read/git.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// Wants what the sides' globs name, ignore rules, and the lock.
WantsFile wanted(const std::vector<std::string>& globs) {
    std::vector<Glob> compiled;
    for (const std::string& text : globs) compiled.emplace_back(text);
    return [compiled](const std::string& path) {
        return path == "portmap.lock" ||
               std::any_of(compiled.begin(), compiled.end(), [&](const Glob& glob) { return glob.matches(path); });
    };
}

MemoryDisk disk_of(const std::string& root, GitFiles files) {
    if (!files.error.empty()) throw CannotDo(files.error);
    MemoryDisk disk;
    for (auto& [path, bytes] : files.files) disk.files[join_path(root, path)] = std::move(bytes);
    return disk;
}

bool same(const LockedPair& a, const LockedPair& b) {
    return a.source_prints == b.source_prints && a.target_prints == b.target_prints;
}

const LockedPair* line_of(const LockFile& lock, const std::string& source, const std::string& target) {
    const auto found = std::find_if(lock.pairs.begin(), lock.pairs.end(),
                                    [&](const LockedPair& p) { return p.source == source && p.target == target; });
    return found == lock.pairs.end() ? nullptr : &*found;
}

const UnitState* find_in(const std::map<std::string, UnitState>& states, const std::string& id) {
    const auto found = states.find(id);
    return found == states.end() ? nullptr : &found->second;
}

/// The line of today's lock that accepts a pair as it is, if it was written since the base.
const LockedPair* accepted_since(const LockFile& then, const LockFile& now, const States& today,
                                 const std::string& source, const std::string& target) {
    const LockedPair* line = line_of(now, source, target);
    if (line == nullptr) return nullptr;
    const LockedPair* old = line_of(then, source, target);
    if (old != nullptr && same(*old, *line)) return nullptr;
    const auto left = today.source.find(source), right = today.target.find(target);
    const bool matches = left != today.source.end() && right != today.target.end() &&
                         left->second.prints == line->source_prints && right->second.prints == line->target_prints;
    return matches ? line : nullptr;
}

/// The target side of another checkout: where it knows no such revision, its own last commit is what it was in step as.
std::string add_other_checkout(MemoryDisk& disk, const Project& project, const std::string& revision) {
    const std::string root = target_root(project);
    std::string note;
    GitFiles files = files_at_base(root, revision, wanted(project.map.target));
    if (!files.error.empty()) {
        files = files_at_base(root, "HEAD", wanted(project.map.target));
        note = "--base " + terminal_text(revision) + " names nothing in " + terminal_text(root) +
               "; its HEAD is taken for the port as it was";
    }
    if (!files.error.empty()) throw CannotDo("target_root: " + files.error);
    for (auto& [path, bytes] : files.files) disk.files[join_path(root, path)] = std::move(bytes);
    return note;
}

}  // namespace

BaseLock base_lock(const Project& project, const std::string& revision, const LockFile& lock, const States& today) {
    std::vector<std::string> globs = project.map.source;
    if (project.map.target_root.empty())
        globs.insert(globs.end(), project.map.target.begin(), project.map.target.end());
    MemoryDisk disk = disk_of(project.root, files_at_base(project.root, revision, wanted(globs)));
    BaseLock out;
    if (!project.map.target_root.empty()) out.note = add_other_checkout(disk, project, revision);
    const FileText old_lock = disk.read(join_path(project.root, "portmap.lock"), kLargestFile);
    const LockFile then = old_lock.error.empty() ? read_lock(old_lock.bytes).lock : LockFile();

    Project past = project;
    read_sides_from(past, disk, target_root(project));
    const States states = read_states(past);
    for (const auto* side : {&states.source, &states.target, &today.source, &today.target})
        for (const auto& [id, state] : *side) out.texts.emplace(state.prints.written, state.text);
    std::set<std::string> mapped;
    for (const MapPair& pair : project.map.pairs) {
        mapped.insert(pair.source);
        for (const std::string& target : pair.targets) {
            if (const LockedPair* line = accepted_since(then, lock, today, pair.source, target)) {
                out.lock.pairs.push_back(*line);
                continue;
            }
            const UnitState* left = find_in(states.source, pair.source);
            const UnitState* right = find_in(states.target, target);
            if (left == nullptr || right == nullptr) {  // the pair is new since the base
                if (const LockedPair* line = line_of(lock, pair.source, target)) {
                    out.lock.pairs.push_back(*line);
                    continue;
                }
                left = find_in(today.source, pair.source);  // nothing to hold it against
                right = find_in(today.target, target);
            }
            if (left != nullptr && right != nullptr)
                out.lock.pairs.push_back({pair.source, target, left->prints, right->prints});
        }
    }
    for (const auto& [id, state] : states.source)
        if (!mapped.contains(id)) out.lock.baseline.push_back({id, state.prints.written});
    out.lock.baseline.insert(out.lock.baseline.end(), lock.baseline.begin(), lock.baseline.end());
    out.lock.ledger = lock.ledger;
    return out;
}

MemoryDisk read_staged_sides(Project& project) {
    const std::string map_folder = project.map_path.substr(0, project.map_path.find_last_of('/'));
    const auto is_of_map = [](const std::string& path) { return path.starts_with("portmap."); };
    MemoryDisk disk = disk_of(map_folder, files_in_index(map_folder, is_of_map));
    if (const auto map = disk.files.find(project.map_path); map != disk.files.end()) {
        ReadMap read = read_map("portmap.toml (staged)", map->second);
        if (!read.error.empty()) throw CannotDo(read.error);
        project.map = std::move(read.map);
    }
    auto add = [&](const std::string& root, const std::vector<std::string>& globs) {
        GitFiles files = files_in_index(root, wanted(globs));
        if (!files.error.empty()) throw CannotDo(files.error);
        for (auto& [path, bytes] : files.files) disk.files[join_path(root, path)] = std::move(bytes);
    };
    add(project.root, project.map.source);
    add(target_root(project), project.map.target);
    read_sides_from(project, disk, target_root(project));
    for (const auto* side : {&project.source, &project.target})
        if (side->empty())
            throw CannotDo(std::string("--staged: the index holds no file of the ") +
                           (side == &project.source ? "source" : "target") +
                           " side\nStage them with: git add; or check without --staged");
    return disk;
}

}  // namespace porttool
