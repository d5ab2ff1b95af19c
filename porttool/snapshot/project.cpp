// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/project.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "porttool/read/refusals.h"
#include "porttool/scan/scan.h"
#include "porttool/snapshot/merge_marks.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// `path` as seen from `root`, if it lies there.
std::optional<std::string> below(const std::string& root, const std::string& path) {
    const std::string folder = root.ends_with('/') ? root : root + "/";
    return path.starts_with(folder) ? std::optional(path.substr(folder.size())) : std::nullopt;
}

/// A map's globs name what lies beneath their side's root: a map is part of what is proposed.
void require_beneath(const std::vector<std::string>& globs, const std::string& root, const char* side) {
    for (const std::string& glob : globs)
        if (leads_out_of(root, glob))
            throw CannotDo("portmap.toml: the " + std::string(side) + " glob '" + terminal_text(glob) +
                           "' leads out of " + terminal_text(root) +
                           "\nGlobs of a map stay beneath the root; a target side in another checkout is named by "
                           "[sides] target_root");
}

/// True for a path with `.git` in it, where a checkout keeps its credentials, or below it.
bool passes_git_folder(const std::string& path) {
    std::error_code error;
    return names_git_folder(path) || names_git_folder(std::filesystem::weakly_canonical(path, error).generic_string());
}

/// The one declared way out is for another checkout: one beneath the root leads nowhere else, and none into `.git`.
void require_target_root(const Project& project, const Disk& disk) {
    const std::string& named = project.map.target_root;
    if (named.empty()) return;
    const auto beneath = below(project.root, target_root(project));
    const bool refused = beneath && disk.kind({project.root, *beneath}) == FileKind::Other;
    std::error_code error;
    if (std::filesystem::weakly_canonical(target_root(project), error) == "/")
        throw CannotDo("portmap.toml: target_root '" + terminal_text(named) +
                       "' is the whole disk; name the folder of the other checkout itself");
    if (refused || passes_git_folder(target_root(project)))
        throw CannotDo(
            "portmap.toml: target_root '" + terminal_text(named) +
            "' leads into .git, or out of the root behind a link\nName the folder of the other checkout itself");
}

/// `cpu=GLOB` names a port, where all targets are written so.
void name_targets(MapFile& map, const std::vector<std::string>& targets) {
    map.target = targets;
    map.target_sets.clear();
    std::map<std::string, std::vector<std::string>> sets;
    for (const std::string& target : targets) {
        const size_t equal = target.find('=');
        if (equal == std::string::npos || !is_set_name(target.substr(0, equal))) return;
        sets[target.substr(0, equal)].push_back(target.substr(equal + 1));
    }
    map.target.clear();
    for (auto& [name, globs] : sets) {
        map.target.insert(map.target.end(), globs.begin(), globs.end());
        map.target_sets.push_back({name, std::move(globs)});
    }
}

}  // namespace

std::string find_root(const Disk& disk, const std::string& directory) {
    const std::string start = absolute_path(directory);
    for (const char* mark : {"portmap.toml", ".git"}) {
        for (std::filesystem::path at = start;; at = at.parent_path()) {
            if (disk.exists(join_path(at.string(), mark))) return at.string();
            if (at == at.parent_path()) break;
        }
    }
    return start;
}

void find_map(Project& project, const ProjectChoice& choice, const Disk& disk) {
    if (choice.source.empty() != choice.target.empty())
        throw CannotDo("--source and --target go together; name both sides, or neither to use portmap.toml");
    project.globs_given = !choice.source.empty();
    project.root = project.globs_given ? absolute_path(choice.directory) : find_root(disk, choice.directory);
    project.map_path = choice.config.empty() ? join_path(project.root, "portmap.toml")
                                             : absolute_path(join_path(choice.directory, choice.config));
    if (!choice.config.empty()) project.map_name = choice.config;
}

TreePath beside_map(const Project& project, const std::string& name, Links links) {
    const size_t slash = project.map_path.find_last_of('/');
    const std::string folder = project.map_path.substr(0, slash + 1);
    if (const auto path = below(project.root, folder + name)) return {project.root, *path, links};
    return {folder, name, links};
}

FileText read_map_text(const Disk& disk, const std::string& root, const std::string& path) {
    const auto beneath = below(root, path);
    return beneath ? disk.read(TreePath{root, *beneath}, kLargestFile) : disk.read(path, kLargestFile);
}

CannotDo no_map(const Project& project) {
    return CannotDo("no portmap.toml in " + terminal_text(project.root) +
                    " or above; write one with: porttool init --source GLOB --target GLOB");
}

void load_map(Project& project, const ProjectChoice& choice, Workplace& place) {
    const bool there = place.disk.exists(project.map_path);
    if (!choice.config.empty() && !there) throw CannotDo("--config " + terminal_text(choice.config) + ": no such file");
    if (!there) return;
    const FileText file = read_map_text(place.disk, project.root, project.map_path);
    if (!file.error.empty()) throw CannotDo(terminal_text(project.map_path) + ": " + file.error);
    use_map(project, project.map_name, file.bytes);
}

void use_map(Project& project, const std::string& name, const std::string& text) {
    if (const auto line = unfinished_merge(text))
        throw CannotDo(terminal_text(name) + ":" + std::to_string(*line) +
                       ": holds the marks of a merge that is not finished (<<<<<<<, =======, >>>>>>>)\n"
                       "Where both sides only added pairs, run: porttool accept --merge; else keep what the merge "
                       "should give, and take the marks out");
    ReadMap read = read_map(name, text);
    if (!read.error.empty()) throw CannotDo(read.error);
    project.map = std::move(read.map);
    project.map_text = text;
    project.has_map = true;
}

Project open_project(const ProjectChoice& choice, Workplace& place, bool needs_map) {
    Project project;
    find_map(project, choice, place.disk);
    if (!project.globs_given || !choice.config.empty()) load_map(project, choice, place);
    if (project.globs_given) {
        project.map.source = choice.source;
        name_targets(project.map, choice.target);
    } else if (!project.has_map && needs_map) {
        throw no_map(project);
    }
    for (const auto* globs : {&project.map.source, &project.map.target})
        if (std::find(globs->begin(), globs->end(), "") != globs->end())
            throw CannotDo(std::string("an empty ") + (globs == &project.map.source ? "source" : "target") +
                           " glob names nothing; for all files write **");
    if (project.map.source.empty() || project.map.target.empty())
        throw CannotDo(
            "no sides named: put [sides] source and target into portmap.toml, or give --source and --target");
    if (!project.globs_given) require_sides_beneath(project, place.disk);
    return project;
}

void require_sides_beneath(const Project& project, const Disk& disk) {
    require_beneath(project.map.source, project.root, "source");
    require_beneath(project.map.target, target_root(project), "target");
    require_target_root(project, disk);
}

std::string target_root(const Project& project) {
    return project.map.target_root.empty() ? project.root
                                           : clean_path(join_path(project.root, project.map.target_root));
}

bool is_elsewhere(const Project& project) {
    return !project.map.target_root.empty() && target_root(project) != project.root &&
           !below(project.root, target_root(project));
}

std::set<std::string> named_files(const MapFile& map, Side side) {
    std::set<std::string> out;
    std::string last;  // file, with the colon: pairs of one mostly follow each other
    const auto add = [&](const std::string& id) {
        if (!last.empty() && id.starts_with(last) && id.find(':', last.size()) == std::string::npos) return;
        std::string file = split_id(id).first;
        last = file + ":";
        out.insert(std::move(file));
    };
    for (const MapPair& pair : map.pairs) {
        if (side == Side::Source) add(pair.source);
        for (const std::string& target : pair.targets)
            if (side == Side::Target) add(target);
    }
    return out;
}

}  // namespace porttool
