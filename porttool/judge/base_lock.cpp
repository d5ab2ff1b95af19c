// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/base_lock.h"

#include <algorithm>
#include <set>

#include "porttool/judge/past_project.h"
#include "porttool/read/git.h"
#include "porttool/read/lock_upgrade.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// Wants what globs name.
WantsFile wanted(const std::vector<std::string>& globs) {
    std::vector<Glob> compiled;
    for (const std::string& text : globs) compiled.emplace_back(text);
    return [compiled](const std::string& path) {
        return std::any_of(compiled.begin(), compiled.end(), [&](const Glob& glob) { return glob.matches(path); });
    };
}

/// Where the map, its lock and the texts of that stand in the commits of a project, as seen from its root.
struct RecordPaths {
    TreePath map, lock;
    std::string base_folder;
    bool in_commits = false;  ///< false: the map is the user's own, elsewhere

    explicit RecordPaths(const Project& project)
        : map(beside_map(project, project.map_path.substr(project.map_path.find_last_of('/') + 1))),
          lock(beside_map(project, "portmap.lock")),
          base_folder(beside_map(project, "portmap.base").path + "/"),
          in_commits(map.root == project.root) {}
};

MemoryDisk disk_of(const std::string& root, GitFiles files) {
    if (!files.error.empty()) throw CannotDo(files.error);
    MemoryDisk disk;
    for (auto& [path, bytes] : files.files) disk.files[join_path(root, path)] = std::move(bytes);
    return disk;
}

bool same(const LockedPair& a, const LockedPair& b) {
    return a.source_prints == b.source_prints && a.target_prints == b.target_prints;
}

/// The lines of a lock by their pair.
class LinesOf {
public:
    explicit LinesOf(const LockFile& lock) {
        for (const LockedPair& pair : lock.pairs) lines_.emplace(std::pair(pair.source, pair.target), &pair);
    }
    const LockedPair* find(const std::string& source, const std::string& target) const {
        const auto found = lines_.find({source, target});
        return found == lines_.end() ? nullptr : found->second;
    }

private:
    std::map<std::pair<std::string, std::string>, const LockedPair*> lines_;
};

const UnitState* find_in(const std::map<std::string, UnitState>& states, const std::string& id) {
    const auto found = states.find(id);
    return found == states.end() ? nullptr : &found->second;
}

/// The line of today's lock that accepts a pair as it is, if it was written since the base.
const LockedPair* accepted_since(const LinesOf& then, const LinesOf& now, const States& today,
                                 const std::string& source, const std::string& target) {
    const LockedPair* line = now.find(source, target);
    if (line == nullptr) return nullptr;
    const LockedPair* old = then.find(source, target);
    if (old != nullptr && same(*old, *line)) return nullptr;
    const UnitState *left = find_in(today.source, source), *right = find_in(today.target, target);
    const bool matches = left != nullptr && right != nullptr && left->prints == line->source_prints &&
                         right->prints == line->target_prints;
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

BaseTree base_tree(const Project& project, const std::string& revision) {
    std::vector<std::string> globs = project.map.source;
    if (project.map.target_root.empty())
        globs.insert(globs.end(), project.map.target.begin(), project.map.target.end());
    const RecordPaths record(project);
    const WantsFile of_sides = wanted(globs);
    const auto wants = [&](const std::string& path) {
        return of_sides(path) || (record.in_commits && (path == record.map.path || path == record.lock.path));
    };
    BaseTree out{revision, disk_of(project.root, files_at_base(project.root, revision, wants)), ""};
    if (!project.map.target_root.empty()) out.note = add_other_checkout(out.disk, project, revision);
    return out;
}

void take_map_of_base(Project& project, const std::string& revision, const Disk& on_disk) {
    const RecordPaths record(project);
    if (!record.in_commits) return;
    const MemoryDisk disk = disk_of(project.root, files_at_base(project.root, revision, [&](const std::string& path) {
                                        return path == record.map.path;
                                    }));
    const FileText text = disk.read(record.map, kLargestFile);
    if (!text.error.empty())
        throw CannotDo("--trusted-map: there is no " + terminal_text(record.map.path) + " at the merge base of " +
                       terminal_text(revision) +
                       "\nMerge a first map into that branch; until then check without --trusted-map");
    ReadMap read = read_map(record.map.path + " at " + revision, text.bytes);
    if (!read.error.empty()) throw CannotDo(read.error);
    project.map = std::move(read.map);
    require_sides_beneath(project, on_disk);
}

BaseRecord base_record(const Project& project, const BaseTree& tree, const RecordedLock& now, const States& today,
                       std::ostream& err) {
    BaseRecord out;
    const RecordPaths record(project);
    if (!record.in_commits) return out;
    if (const FileText text = tree.disk.read(record.map, kLargestFile); text.error.empty()) {
        ReadMap read = text.bytes == project.map_text ? ReadMap{project.map, ""}
                                                      : read_map(record.map.path + " at " + tree.revision, text.bytes);
        out.has_map = read.error.empty();
        out.map = std::move(read.map);
        if (!out.has_map) err << "warning: " << read.error << "\nThat map is left out\n";
    }
    const FileText text = tree.disk.read(record.lock, kLargestFile);
    if (!text.error.empty()) return out;
    if (text.bytes == now.written) {
        out.lock = now;
        out.has_lock = true;
        return out;
    }
    try {
        ReadLock read = read_lock(text.bytes);
        MemoryDisk disk;
        if (is_outdated(read.lock))  // only then are the texts behind it needed
            disk = disk_of(project.root, files_at_base(project.root, tree.revision, [&](const std::string& path) {
                               return path.starts_with(record.base_folder);
                           }));
        out.lock = lock_of_today(project, disk, std::move(read), today);
        out.has_lock = true;
    } catch (const CannotDo& problem) {
        err << "warning: at " << terminal_text(tree.revision) << ": " << problem.what() << "\nThat lock is left out\n";
    }
    return out;
}

BaseLock base_lock(const Project& project, const BaseTree& tree, const LockFile& then, const LockFile& now,
                   const States& today) {
    BaseLock out;
    Project past = project;
    read_sides_from(past, tree.disk, target_root(project));
    out.suppressions = placed_suppressions(past);
    const States states = read_states(past);
    for (const auto* side : {&states.source, &states.target, &today.source, &today.target})
        for (const auto& [id, state] : *side) out.texts.emplace(state.prints.written, state.text);
    const LinesOf lines_then(then), lines_now(now);
    std::set<std::string> mapped;
    for (const MapPair& pair : project.map.pairs) {
        mapped.insert(pair.source);
        for (const std::string& target : pair.targets) {
            if (const LockedPair* line = accepted_since(lines_then, lines_now, today, pair.source, target)) {
                out.lock.pairs.push_back(*line);
                continue;
            }
            const UnitState* left = find_in(states.source, pair.source);
            const UnitState* right = find_in(states.target, target);
            if (left == nullptr || right == nullptr) {  // the pair is new since the base
                if (const LockedPair* line = lines_now.find(pair.source, target)) {
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
        if (!mapped.contains(id)) out.lock.baseline.push_back({id, state.prints});
    out.lock.baseline.insert(out.lock.baseline.end(), now.baseline.begin(), now.baseline.end());
    out.lock.ledger = now.ledger;
    return out;
}

MemoryDisk staged_record(Project& project, const Disk& on_disk) {
    const std::string map_folder = project.map_path.substr(0, project.map_path.find_last_of('/'));
    const auto is_of_map = [](const std::string& path) { return path.starts_with("portmap."); };
    MemoryDisk disk = disk_of(map_folder, files_in_index(map_folder, is_of_map));
    if (const auto map = disk.files.find(project.map_path); map != disk.files.end()) {
        ReadMap read = read_map("portmap.toml (staged)", map->second);
        if (!read.error.empty()) throw CannotDo(read.error);
        project.map = std::move(read.map);
        require_sides_beneath(project, on_disk);
    }
    return disk;
}

void read_staged_sides(Project& project, MemoryDisk& disk) {
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
}

}  // namespace porttool
