// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/folder_of_base.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <vector>

#include "porttool/read/git_repository.h"
#include "porttool/text/sink/shell.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMap = "portmap.toml";

std::string real_path(const std::string& path) {
    std::error_code error;
    return fs::weakly_canonical(path, error).generic_string();
}

/// The folder as the user named it: where a shell went through a link, it alone knows that.
std::string folder_as_named(const std::string& directory) {
    std::error_code error;
    const char* shell = std::getenv("PWD");
    const bool is_here = shell != nullptr && *shell == '/' && fs::equivalent(shell, ".", error);
    return is_here ? absolute_path(join_path(shell, directory)) : absolute_path(directory);
}

/// A folder and all above it.
std::vector<std::string> upwards(const std::string& folder) {
    std::vector<std::string> out;
    for (fs::path at = folder; out.empty() || at.generic_string() != out.back(); at = at.parent_path())
        out.push_back(at.generic_string());
    return out;
}

bool is_in(const std::string& path, const std::string& folder) {
    return path == folder || path.starts_with(folder + "/");
}

std::string below_root(const std::string& root, const std::string& path) {
    return path == root ? "" : path.substr(root.size() + (root.ends_with('/') ? 0 : 1));
}

/// A work tree around the folder in question, and what its merge base has of that.
struct WorkTreeAround {
    std::string root;
    FolderAtBase then;
};

std::vector<WorkTreeAround> work_trees_around(const std::string& folder, const std::string& revision,
                                              const Disk& disk) {
    std::vector<WorkTreeAround> out;
    for (const std::string& root : upwards(folder)) {
        if (!disk.exists(join_path(root, ".git"))) continue;
        const GitRepository git(root, kChecksWithGit);
        out.push_back({root, git.folder_at_base(revision, below_root(root, folder), kMap)});
    }
    return out;
}

/// Most checks are of a work tree's own folder, with nothing around it that could count: then git need not be asked.
bool is_outermost(const std::string& folder, const Disk& disk) {
    if (!disk.exists(join_path(folder, ".git"))) return false;
    const std::vector<std::string> all = upwards(folder);
    return std::none_of(all.begin() + 1, all.end(), [&](const std::string& above) {
        return disk.exists(join_path(above, ".git")) || disk.exists(join_path(above, kMap));
    });
}

/// The nearest folder upwards with a map, as the merge base has it; what lies in no work tree is as it is.
std::optional<std::string> nearest_map_then(const std::string& folder, const std::vector<WorkTreeAround>& trees,
                                            const Disk& disk) {
    for (const std::string& at : upwards(folder)) {
        const auto tree = std::find_if(trees.begin(), trees.end(), [&](const WorkTreeAround& one) {
            return one.then.error.empty() && is_in(at, one.root);
        });
        const bool has_map = tree == trees.end() ? disk.exists(join_path(at, kMap))
                                                 : tree->then.marked.contains(below_root(tree->root, at));
        if (has_map) return at;
    }
    return std::nullopt;
}

CannotDo other_folder(const std::string& folder, const std::string& revision) {
    return CannotDo(terminal_text(folder) + " leads to " + terminal_text(real_path(folder)) +
                    ", and was a folder of its own at the merge base of " + terminal_text(revision) +
                    "\nPut it back, or check where it leads to by that name");
}

CannotDo other_module(const std::string& module, const std::string& revision) {
    return CannotDo(terminal_text(module) + " was a submodule at the merge base of " + terminal_text(revision) +
                    ", and is no repository of its own there now\nPut it back, or check the repository around it");
}

CannotDo either_folder(const std::string& link, const std::string& folder, const std::string& revision) {
    return CannotDo(terminal_text(link) + " leads to " + terminal_text(real_path(link)) +
                    ", and was a folder of its own at the merge base of " + terminal_text(revision) +
                    ": which of both this was started in cannot be told\nName the folder: porttool check -C " +
                    terminal_text(shell_quoted(folder)));
}

CannotDo own_repository(const std::string& folder, const std::string& revision) {
    return CannotDo(terminal_text(folder) +
                    " is a repository of its own, and was a folder of the one around it at the "
                    "merge base of " +
                    terminal_text(revision) +
                    "\nPut it back; a submodule that is new is checked in a folder that is new");
}

/// A process that was started in a folder which the change made a link finds itself where that leads to, and only a
/// shell that went there itself knows by which name.
void require_no_link_here(const std::string& folder, const std::string& root, const std::string& revision) {
    for (const std::string& name : GitRepository(root, kChecksWithGit).links_for_folders(revision)) {
        const std::string link = join_path(root, name), end = real_path(link), here = real_path(folder);
        if (is_in(here, end)) throw either_folder(link, folder, revision);
    }
}

/// A submodule of the merge base must be one still, in its own place.
void require_module_of_base(const WorkTreeAround& tree, const std::string& revision, const Disk& disk) {
    const ModulePath& module = tree.then.module;
    if (module.named.empty()) return;
    const std::string folder = join_path(tree.root, module.named);
    if (real_path(folder) != clean_path(join_path(real_path(tree.root), module.real)))
        throw other_folder(folder, revision);
    if (!disk.exists(join_path(folder, ".git"))) throw other_module(folder, revision);
}

CannotDo other_map(const Project& project, const std::string& then, const std::string& revision) {
    const std::string base = " at the merge base of " + terminal_text(revision);
    if (upwards(then).size() > upwards(project.root).size())
        return CannotDo("portmap.toml of " + terminal_text(then) + " is gone, which was there" + base +
                        "; without it " + terminal_text(project.map_path) +
                        " would be used\nPut it back, or check the folder above");
    return CannotDo(terminal_text(project.map_path) + " is new;" + base + " the map of " + terminal_text(then) +
                    " was used here\nCheck that folder, or name the new map by --config");
}

}  // namespace

void require_folder_of_base(const Project& project, const ProjectChoice& choice, const std::string& revision,
                            const Disk& disk) {
    const std::string folder = folder_as_named(choice.directory);
    const bool is_named = choice.directory != ".", is_alone = is_outermost(folder, disk);
    if (is_alone && !is_named) require_no_link_here(folder, folder, revision);
    if (is_alone) return;
    const std::vector<WorkTreeAround> trees = work_trees_around(folder, revision, disk);
    for (const WorkTreeAround& tree : trees)
        if (!is_named) require_no_link_here(folder, tree.root, revision);
    for (const WorkTreeAround& tree : trees) require_module_of_base(tree, revision, disk);
    for (const WorkTreeAround& tree : trees)
        if (tree.then.is_there && real_path(folder) != clean_path(join_path(real_path(tree.root), tree.then.path)))
            throw other_folder(folder, revision);
    for (size_t outer = 1; outer < trees.size(); ++outer)
        if (trees[outer].then.is_there) throw own_repository(trees.front().root, revision);
    if (!trees.empty() && !trees.front().then.error.empty() && is_in(project.root, trees.front().root))
        throw CannotDo(trees.front().then.error);
    const bool is_new = !trees.empty() && trees.front().then.error.empty() && !trees.front().then.is_there;
    if (is_new || project.globs_given || !choice.config.empty()) return;
    const std::optional<std::string> then = nearest_map_then(folder, trees, disk);
    if (then && real_path(*then) != real_path(project.root)) throw other_map(project, *then, revision);
}

}  // namespace porttool
