// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/project.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "porttool/read/git.h"
#include "porttool/read/glob.h"
#include "porttool/scan/scan.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

std::string absolute(const std::string& path) {
    std::error_code error;
    return clean_path(std::filesystem::absolute(path, error).generic_string());
}

std::vector<ScannedFile> scan_all(const SourceSet& set) {
    std::vector<ScannedFile> files;
    files.reserve(set.files.size());
    for (const SourceText& source : set.files) files.push_back(scan_text(source.path, source.text));
    return files;
}

/// A bracket that is never closed stands for itself, as in a shell, which is rarely what was meant.
std::string bracket_hint(const std::string& glob) {
    for (const auto& [open, close] : {std::pair('[', ']'), std::pair('{', '}')})
        if (std::count(glob.begin(), glob.end(), open) > std::count(glob.begin(), glob.end(), close))
            return std::string("; its '") + open + "' is never closed";
    return "; globs are relative to the root, ** crosses folders";
}

void require_matches(const std::vector<std::string>& unmatched, const char* side) {
    if (unmatched.empty()) return;
    throw CannotDo(std::string(side) + " glob '" + terminal_text(unmatched.front()) + "' matches no file that is read" +
                   bracket_hint(unmatched.front()));
}

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

/// True for a path with `.git` in it, where a checkout keeps its credentials.
bool passes_git_folder(const std::string& path) {
    std::error_code error;
    for (const std::filesystem::path& spelling :
         {std::filesystem::path(path), std::filesystem::weakly_canonical(path, error)})
        if (std::any_of(spelling.begin(), spelling.end(),
                        [](const auto& name) { return is_git_folder(name.string()); }))
            return true;
    return false;
}

/// The one declared way out is for another checkout: one beneath the root leads nowhere else, and none into `.git`.
void require_target_root(const Project& project, const Disk& disk) {
    const std::string& named = project.map.target_root;
    if (named.empty()) return;
    const auto beneath = below(project.root, target_root(project));
    const bool refused = beneath && disk.kind({project.root, *beneath}) == FileKind::Other;
    if (refused || passes_git_folder(target_root(project)))
        throw CannotDo(
            "portmap.toml: target_root '" + terminal_text(named) +
            "' leads into .git, or out of the root behind a link\nName the folder of the other checkout itself");
}

}  // namespace

std::string find_root(const Disk& disk, const std::string& directory) {
    std::error_code error;
    std::string absolute = std::filesystem::absolute(directory, error).lexically_normal().generic_string();
    if (absolute.size() > 1 && absolute.ends_with('/')) absolute.pop_back();
    for (const char* mark : {"portmap.toml", ".git"}) {
        for (std::filesystem::path at = absolute;; at = at.parent_path()) {
            if (disk.exists(join_path(at.string(), mark))) return at.string();
            if (at == at.parent_path()) break;
        }
    }
    return absolute;
}

void find_map(Project& project, const ProjectChoice& choice, const Disk& disk) {
    if (choice.source.empty() != choice.target.empty())
        throw CannotDo("--source and --target go together; name both sides, or neither to use portmap.toml");
    project.globs_given = !choice.source.empty();
    project.root = project.globs_given ? absolute(choice.directory) : find_root(disk, choice.directory);
    project.map_path = choice.config.empty() ? join_path(project.root, "portmap.toml")
                                             : absolute(join_path(choice.directory, choice.config));
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

Project open_project(const ProjectChoice& choice, Workplace& place, bool needs_map) {
    Project project;
    find_map(project, choice, place.disk);
    const bool there = place.disk.exists(project.map_path);
    if (!choice.config.empty() && !there) throw CannotDo("--config " + terminal_text(choice.config) + ": no such file");
    if (there && (!project.globs_given || !choice.config.empty())) {
        const FileText file = read_map_text(place.disk, project.root, project.map_path);
        if (!file.error.empty()) throw CannotDo(terminal_text(project.map_path) + ": " + file.error);
        project.map_text = file.bytes;
        ReadMap read = read_map(choice.config.empty() ? "portmap.toml" : choice.config, file.bytes);
        if (!read.error.empty()) throw CannotDo(read.error);
        project.map = std::move(read.map);
        project.has_map = true;
    }
    if (project.globs_given) {
        project.map.source = choice.source;
        project.map.target = choice.target;
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

namespace {

/// The files of one side that the map's pairs name.
std::set<std::string> named_files(const MapFile& map, bool source) {
    std::set<std::string> out;
    for (const MapPair& pair : map.pairs) {
        if (source) out.insert(split_id(pair.source).first);
        for (const std::string& target : pair.targets)
            if (!source) out.insert(split_id(target).first);
    }
    return out;
}

SourceSet read_side(const Project& project, const Disk& disk, bool source, std::vector<std::string>& unmatched) {
    const std::string root = source ? project.root : target_root(project);
    const std::vector<std::string>& globs = source ? project.map.source : project.map.target;
    const auto tracked = [&] {
        return tracked_files(root, [patterns = std::vector<Glob>(globs.begin(), globs.end())](const std::string& path) {
            return std::any_of(patterns.begin(), patterns.end(), [&](const Glob& glob) { return glob.matches(path); });
        });
    };
    return read_globs(disk, root, globs, unmatched,
                      {project.globs_given ? Reach::Anywhere : Reach::Beneath, !source && is_elsewhere(project),
                       named_files(project.map, source), tracked});
}

}  // namespace

void read_sides(Project& project, Workplace& place) {
    std::vector<std::string> unmatched;
    const SourceSet source = read_side(project, place.disk, true, unmatched);
    require_matches(unmatched, "source");
    const SourceSet target = read_side(project, place.disk, false, unmatched);
    require_matches(unmatched, "target");
    project.source = scan_all(source);
    project.target = scan_all(target);
    project.skipped = source.skipped;
    for (const SkippedFile& file : target.skipped)
        project.skipped.push_back(
            {project.map.target_root.empty() ? file.file : clean_path(join_path(project.map.target_root, file.file)),
             file.reason});
}

void read_sides_from(Project& project, const Disk& disk, const std::string& target_root) {
    std::vector<std::string> unmatched;
    project.source = scan_all(read_globs(disk, project.root, project.map.source, unmatched));
    project.target = scan_all(read_globs(disk, target_root, project.map.target, unmatched));
    project.skipped.clear();
}

std::string target_root(const Project& project) {
    return project.map.target_root.empty() ? project.root
                                           : clean_path(join_path(project.root, project.map.target_root));
}

bool is_elsewhere(const Project& project) {
    return !project.map.target_root.empty() && target_root(project) != project.root &&
           !below(project.root, target_root(project));
}

}  // namespace porttool
