// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/output_file.h"

#include <filesystem>
#include <fstream>
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

bool is_beneath(const std::string& file, const std::string& folder) {
    return file.starts_with(folder.ends_with('/') ? folder : folder + "/");
}

/// The folder in which git keeps what it knows of a work tree; "" where the folder is none.
std::string git_folder_of(const std::filesystem::path& work_tree) {
    const std::filesystem::path entry = work_tree / ".git";
    std::error_code error;
    if (std::filesystem::is_directory(entry, error)) return plain_path(entry.generic_string());
    constexpr std::string_view kGitDir = "gitdir: ";
    std::string line;
    if (!std::filesystem::is_regular_file(entry, error) || !std::getline(std::ifstream(entry), line)) return {};
    if (!line.starts_with(kGitDir)) return {};
    return plain_path((work_tree / line.substr(kGitDir.size())).generic_string());
}

/// Where a link takes a name in the project's folder, or in that of a repository around it, that it must not: out of
/// the folder, or to what git keeps. A commit can hold that link. "" if nowhere.
std::string led_to(const Project& project, const std::string& path) {
    const std::string named = absolute_path(path), written = written_place(named), root = plain_path(project.root);
    const auto leaves = [&](const std::string& folder) {
        return is_beneath(named, folder) && !is_beneath(written, plain_path(folder));
    };
    if (!project.root.empty())
        for (const std::string& folder : {root, absolute_path(project.root)})
            if (leaves(folder)) return "out of " + terminal_text(project.root);
    for (std::filesystem::path folder = std::filesystem::path(named).parent_path();; folder = folder.parent_path()) {
        const std::string git = git_folder_of(folder);
        if (!git.empty() && leaves(folder.generic_string())) return "out of " + terminal_text(folder.generic_string());
        if (!git.empty() && is_beneath(written, git) && !is_beneath(named, git)) return "into git's own folder";
        if (!folder.has_relative_path()) return {};
    }
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
    if (const std::string place = led_to(project, path); !place.empty())
        throw CannotDo(option + " is a link, or lies behind one, that leads " + place +
                       ": a change may have brought it\nRemove the link, or name the file that it leads to");
    if (!disk.exists(path)) return;
    const std::string file = plain_path(absolute_path(path));
    std::string what = part_of_project(project, file);
    for (const std::string& read : options.paths)
        if (what.empty() && file == plain_path(absolute_path(join_path(options.directory, read)))) what = "is read";
    if (!what.empty()) throw CannotDo(option + " " + what + ", which would be lost; name another file");
}

}  // namespace porttool
