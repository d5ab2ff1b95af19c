// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/output_file.h"

#include <filesystem>
#include <sstream>

#include "porttool/read/source_glob.h"
#include "porttool/snapshot/lock_store.h"
#include "porttool/snapshot/project.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// A path without links and detours, so that one file has one.
std::string plain_path(const std::string& path) {
    std::error_code error;
    const std::filesystem::path plain = std::filesystem::weakly_canonical(path, error);
    return error ? path : plain.generic_string();
}

/// A project as far as its map tells of it; one whose map cannot be read is told of by the command itself.
Project named_project(const Options& options, Disk& disk) {
    Project project;
    std::ostringstream unsaid;
    Workplace place{disk, unsaid};
    try {
        find_map(project, options, disk);
        if (!project.globs_given || !options.config.empty()) load_map(project, options, place);
    } catch (const CannotDo&) {
        return project;
    }
    if (project.globs_given) {
        project.map.source = options.source;
        project.map.target = options.target;
    }
    return project;
}

/// Where a file that may be a link, also one that leads nowhere yet, is or would be made.
std::string written_place(std::filesystem::path file) {
    constexpr int kMostLinks = 40;
    std::error_code error;
    for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(std::filesystem::symlink_status(file, error)); ++i)
        file = file.parent_path() / std::filesystem::read_symlink(file, error);
    return plain_path(file.generic_string());
}

/// True for a name in the project's folder that a link takes out of it: a commit can hold that link.
bool leads_out(const Project& project, const std::string& path) {
    const auto beneath = [](const std::string& file, const std::string& folder) {
        return file.starts_with(folder.ends_with('/') ? folder : folder + "/");
    };
    const std::string named = absolute_path(path), root = plain_path(project.root);
    const bool is_named_beneath = beneath(named, root) || beneath(named, absolute_path(project.root));
    return !project.root.empty() && is_named_beneath && !beneath(written_place(named), root);
}

/// What a file is to a project, or "".
std::string part_of_project(const Project& project, const std::string& file) {
    const auto is = [&](const std::string& path) { return file == plain_path(path); };
    if (is(project.map_path)) return "is the map";
    if (!project.map_path.empty() && is(lock_path(project))) return "is the lock";
    const TreePath texts = beside_map(project, "portmap.base");
    if (file.starts_with(plain_path(join_path(texts.root, texts.path)) + "/")) return "is one of the lock's texts";
    const auto takes = [&](const std::vector<std::string>& globs, const std::string& root) {
        return SideGlobs(globs).takes(path_below(plain_path(root), file));
    };
    if (takes(project.map.source, project.root)) return "is a source";
    if (takes(project.map.target, target_root(project))) return "is a port";
    return {};
}

}  // namespace

void require_output(const Options& options, const std::string& option, const std::string& path, Disk& disk) {
    const std::string folder = std::filesystem::path(path).parent_path().generic_string();
    if (!folder.empty() && !disk.is_directory(folder))
        throw CannotDo(option + ": there is no folder " + terminal_text(folder) + "; make it first");
    if (disk.is_directory(path)) throw CannotDo(option + " is a folder; name a file in it");
    const Project project = named_project(options, disk);
    if (leads_out(project, path))
        throw CannotDo(option + " is a link, or lies behind one, that leads out of " + terminal_text(project.root) +
                       ": a change may have brought it\nRemove the link, or name the file that it leads to");
    if (!disk.exists(path)) return;
    const std::string file = plain_path(absolute_path(path));
    std::string what = part_of_project(project, file);
    for (const std::string& read : options.paths)
        if (what.empty() && file == plain_path(absolute_path(join_path(options.directory, read)))) what = "is read";
    if (!what.empty()) throw CannotDo(option + " " + what + ", which would be lost; name another file");
}

}  // namespace porttool
