// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/past_project.h"

#include <algorithm>

#include "porttool/read/git.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// The folder of the map as seen from the root, "" or "sub/folder/".
std::string map_folder(const Project& project) {
    const std::string folder = project.map_path.substr(0, project.map_path.find_last_of('/') + 1);
    const std::string root = project.root.ends_with('/') ? project.root : project.root + "/";
    return folder.starts_with(root) ? folder.substr(root.size()) : std::string();
}

/// Wants the sides, the map, the lock and the texts behind it.
WantsFile wanted(const Project& project) {
    std::vector<Glob> globs;
    for (const auto* side : {&project.map.source, &project.map.target})
        for (const std::string& text : *side) globs.emplace_back(text);
    const std::string folder = map_folder(project);
    return [globs, folder](const std::string& path) {
        if (path == folder + "portmap.toml" || path == folder + "portmap.lock") return true;
        if (path.starts_with(folder + "portmap.base/")) return true;
        return std::any_of(globs.begin(), globs.end(), [&](const Glob& glob) { return glob.matches(path); });
    };
}

/// The pairs and exceptions that the map of that time named.
void take_pairs(MapFile& map, const Project& today, const Disk& disk) {
    const FileText text = disk.read(join_path(today.root, map_folder(today) + "portmap.toml"), kLargestFile);
    if (!text.error.empty()) return;
    ReadMap read = read_map("portmap.toml", text.bytes);
    if (!read.error.empty()) return;  // an older form: today's pairs are the best guess
    map.pairs = std::move(read.map.pairs);
    map.ignores = std::move(read.map.ignores);
    map.rules = std::move(read.map.rules);
}

}  // namespace

std::vector<PlacedSuppression> placed_suppressions(const Project& project) {
    std::vector<PlacedSuppression> suppressions;
    for (const auto* side : {&project.source, &project.target})
        for (const ScannedFile& file : *side)
            for (const Suppression& comment : file.lexed.suppressions)
                suppressions.push_back(
                    {side == &project.source ? file.path : target_path(project.map, file.path), comment});
    return suppressions;
}

void read_past(PastProject& past, const Project& today, const std::string& revision, const std::string& date) {
    if (!today.map.target_root.empty())
        throw CannotDo("--base " + terminal_text(revision) +
                       ": the target side lies in another checkout ([sides] target_root), whose history is not read\n"
                       "Report without --base");
    GitFiles files = files_at_base(today.root, revision, wanted(today));
    if (!files.error.empty()) throw CannotDo(files.error);
    MemoryDisk disk;
    for (auto& [path, bytes] : files.files) disk.files[join_path(today.root, path)] = std::move(bytes);
    past.project.root = today.root;
    past.project.map_path = today.map_path;
    past.project.map = today.map;
    take_pairs(past.project.map, today, disk);
    read_sides_from(past.project, disk, today.root);
    past.states = read_states(past.project);
    past.is_recorded = disk.exists(lock_path(past.project));
    if (past.is_recorded) past.lock = load_lock(past.project, disk, past.states);
    const auto text_of = [&](const std::string& print) {
        const auto found = past.lock.texts.find(print);
        return found != past.lock.texts.end() ? found->second : base_text(past.project, disk, print);
    };
    past.judgement = judge({past.project.map, past.lock.lock, past.states.source, past.states.target,
                            past.project.skipped, text_of, date, placed_suppressions(past.project)});
}

}  // namespace porttool
