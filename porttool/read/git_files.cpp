// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The files of a commit and of the index.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <vector>

#include "porttool/read/disk.h"
#include "porttool/read/git_base.h"
#include "porttool/read/git_links.h"
#include "porttool/read/git_open.h"
#include "porttool/read/source_files.h"
#include "porttool/text/sink/shell.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

const std::string kMergeBase = "the merge base";  // as messages call it

/// Where the files of one repository go.
struct Walk {
    GitFiles& out;
    git_repository* repository;
    std::string prefix;  ///< the folder of the repository that is read, "sub/folder/" or ""
    std::string before;  ///< what stands before its paths in `out`: the place of a submodule
    const WantsFile& wants;
    const std::vector<std::string>& folders;  ///< with all that is wanted, as paths in `out`; none for anywhere
    EntryCount& entries;
    uint64_t& bytes;                    ///< that were read in all
    GitEntryAt at = {};                 ///< what stands at a path
    std::string alias = {}, real = {};  ///< a folder that is read under the path of a link to it, and its own path

    /// The path that a file has in `out`.
    std::string name_of(const std::string& path) const { return before + path.substr(prefix.size()); }

    /// Where a path leads to.
    GitPlace follow(const std::string& path) const {
        const std::string own = alias.empty() ? path : real + path.substr(alias.size());
        return follow_git_links(repository, at, entries, own);
    }

    /// True if a folder ("a/b/") holds something wanted, or leads to the root.
    bool leads_to_wanted(const std::string& folder) const {
        if (folder.size() > kLongestGitPath) return false;
        if (!folder.starts_with(prefix)) return prefix.starts_with(folder);
        const std::string name = name_of(folder);
        return folders.empty() || std::any_of(folders.begin(), folders.end(), [&](const std::string& one) {
                   return one == "." || name.starts_with(one + "/") || (one + "/").starts_with(name);
               });
    }
};

/// Reads one file; false with an error in `out` if it is not here, or if it is one too many.
bool add_blob(const Walk& walk, const git_oid& id, const std::string& path) {
    auto blob = read_git_blob(walk.repository, id);
    if (!blob) {
        walk.out.error = terminal_text(path) + ": git knows this file, but its text is not here (" + git_last_error() +
                         "), as in a partial clone\nFetch it: git fetch --refetch --no-filter";
        return false;
    }
    if (blob->size > kLargestFile) {
        walk.out.unreadable[path] = too_large(blob->size, kLargestSource);
        return true;
    }
    walk.bytes += blob->size;
    if (walk.bytes > kMostSourceBytes) {
        walk.out.error = fmt::format(
            "what the globs name is more than the {} bytes of sources that are read, as git has it\n"
            "Narrow the globs, or take the largest files out of them",
            kMostSourceBytes);
        return false;
    }
    walk.out.files[path] = std::move(blob->bytes);
    return true;
}

/// Reads the file behind a link, as the work tree shows it; a link that leads nowhere here is no file.
bool add_linked(const Walk& walk, const std::string& path) {
    const GitPlace place = walk.follow(path);
    if (place.is_elsewhere) walk.out.unknown.insert(walk.name_of(path));
    return place.entry.kind != GitEntry::Kind::File || add_blob(walk, place.entry.id, walk.name_of(path));
}

bool read_tree(const Walk& walk, const git_oid& commit_id);

/// Reads a submodule at the commit that its parent names. False if a commit that is needed is not here.
bool read_submodule(const Walk& walk, const git_oid& commit, const std::string& path) {
    if (!walk.leads_to_wanted(path + "/")) return true;
    const char* workdir = git_repository_workdir(walk.repository);
    const OwnedRepository repository(workdir == nullptr ? nullptr : open_work_tree(workdir + path + "/.git"));
    if (!repository) {
        walk.out.unknown.insert(walk.name_of(path));
        return true;
    }
    const Walk inside{walk.out,   repository.get(), "",           walk.name_of(path) + "/",
                      walk.wants, walk.folders,     walk.entries, walk.bytes};
    if (read_tree(inside, commit)) return true;
    const OwnedIndex index = git_index_of(repository.get());
    if (!index) return true;
    bool wanted = false;
    for (size_t i = 0; i < git_index_entrycount(index.get()) && !wanted; ++i)
        wanted = walk.wants(inside.name_of(git_index_get_byindex(index.get(), i)->path));
    if (wanted) return false;
    walk.out.error.clear();  // of today's submodule the map names nothing; what it held then is not known
    walk.out.unknown.insert(walk.name_of(path));
    return true;
}

bool read_folder(const Walk& walk, const git_tree* tree, const std::string& folder);

/// Reads one entry of a tree; false with an error in `out` where that cannot be done.
bool read_entry(const Walk& walk, const git_tree_entry* entry, const std::string& path) {
    const git_oid& id = *git_tree_entry_id(entry);
    if (git_tree_entry_type(entry) == GIT_OBJECT_TREE) {
        const std::string inside = path + "/";
        if (!walk.leads_to_wanted(inside)) return true;
        const OwnedTree tree = git_tree_at(walk.repository, id);
        return tree && read_folder(walk, tree.get(), inside);
    }
    if (!path.starts_with(walk.prefix)) return true;
    if (git_tree_entry_type(entry) == GIT_OBJECT_COMMIT) return read_submodule(walk, id, path);
    if (git_tree_entry_type(entry) != GIT_OBJECT_BLOB || !walk.wants(walk.name_of(path))) return true;
    const bool link = git_tree_entry_filemode(entry) == GIT_FILEMODE_LINK;
    return link ? add_linked(walk, path) : add_blob(walk, id, walk.name_of(path));
}

bool read_folder(const Walk& walk, const git_tree* tree, const std::string& folder) {
    const size_t count = git_tree_entrycount(tree);
    walk.entries.add(count);
    for (size_t i = 0; i < count; ++i) {
        const git_tree_entry* entry = git_tree_entry_byindex(tree, i);
        if (!read_entry(walk, entry, folder + git_tree_entry_name(entry))) return false;
    }
    return true;
}

/// Calls `read` with the walk under the path of a link, for each wanted folder that lies behind one: a work tree shows
/// its files there. False where that is.
bool for_linked_folders(const Walk& walk, const std::function<bool(const Walk&, const GitPlace&)>& read) {
    for (const std::string& name : walk.folders) {
        if (!name.starts_with(walk.before)) continue;
        const std::string path = walk.prefix + (name == "." ? "" : name.substr(walk.before.size()));
        const GitPlace place = walk.follow(path);
        if (!place.by_link) continue;
        if (place.is_elsewhere) walk.out.unknown.insert(name);
        if (place.entry.kind != GitEntry::Kind::Folder) continue;
        Walk aliased = walk;
        aliased.alias = path;
        aliased.real = place.path;
        if (!read(aliased, place)) return false;
    }
    return true;
}

bool read_linked_folder(const Walk& walk, const GitPlace& place) {
    const OwnedTree tree = git_tree_at(walk.repository, place.entry.id);
    return tree && read_folder(walk, tree.get(), walk.alias + "/");
}

bool read_tree(const Walk& walk, const git_oid& commit_id) {
    const OwnedCommit commit = git_commit_at(walk.repository, commit_id);
    if (!commit) {
        walk.out.error = (walk.before.empty() ? kMergeBase : "the submodule " + terminal_text(walk.before)) +
                         " cannot be read: " + git_last_error() + "\nFetch it: " +
                         (walk.before.empty() ? "git fetch"
                                              : "git submodule update --init; or git -C " +
                                                    terminal_text(shell_quoted(walk.before)) + " fetch --unshallow");
        return false;
    }
    const OwnedTree tree = git_tree_of(commit.get());
    if (!tree) {
        walk.out.error = kMergeBase + " cannot be read: " + git_last_error() + "\nLook into it with: git fsck";
        return false;
    }
    Walk payload = walk;
    payload.at = entries_of_tree(tree.get());
    if (!(read_folder(payload, tree.get(), "") && for_linked_folders(payload, read_linked_folder)) &&
        walk.out.error.empty())
        walk.out.error = kMergeBase + " cannot be read: " + git_last_error() + "\nLook into it with: git fsck";
    return walk.out.error.empty();
}

}  // namespace

GitFiles GitRepository::files_at_base(const std::string& revision, const WantsFile& wants,
                                      const std::vector<std::string>& folders) const {
    if (!error_.empty()) return {{}, {}, {}, error_};
    GitFiles out;
    git_repository* repository = handle_->repository();
    const MergeBase base = merge_base_with(repository, revision);
    if (!base.error.empty()) return {{}, {}, {}, base.error};
    EntryCount entries(kMergeBase);
    uint64_t bytes = 0;
    out.note = base.note;
    read_tree({out, repository, folder(), "", wants, folders, entries, bytes}, base.commit);
    return out;
}

namespace {

/// Where the commit that is being made has its index: `git commit -a` and `git commit FILE` give their hooks one of
/// their own beside the usual one, and name it in GIT_INDEX_FILE. "" for the usual one, and where the variable is about
/// another repository.
std::string index_of_hook(git_repository* repository) {
    const char* named = std::getenv("GIT_INDEX_FILE");
    if (named == nullptr || *named == '\0') return {};
    std::error_code error;
    for (const std::string& from : {std::string("."), std::string(git_repository_workdir(repository))}) {
        const std::filesystem::path path = std::filesystem::path(from) / named;
        if (std::filesystem::exists(path, error) &&
            std::filesystem::equivalent(path.parent_path(), git_repository_path(repository), error))
            return path.string();
    }
    return {};
}

}  // namespace

std::set<std::string> GitRepository::left_out_of(const std::string& folder_of_names) const {
    std::set<std::string> out;
    const OwnedIndex index = error_.empty() ? git_index_of(handle_->repository()) : nullptr;
    if (!index) return out;
    const std::string before = folder() + (folder_of_names.empty() ? "" : folder_of_names + "/");
    size_t i = 0;
    if (!before.empty() && git_index_find_prefix(&i, index.get(), before.c_str()) != 0) return out;
    for (; i < git_index_entrycount(index.get()); ++i) {
        const git_index_entry& entry = *git_index_get_byindex(index.get(), i);
        const std::string_view path = entry.path;
        if (!path.starts_with(before)) break;
        if ((entry.flags_extended & GIT_INDEX_ENTRY_SKIP_WORKTREE) != 0) out.emplace(path.substr(before.size()));
    }
    return out;
}

std::optional<std::string> GitRepository::ancestor_in_merge(const std::string& path) const {
    const OwnedIndex index = error_.empty() ? git_index_of(handle_->repository()) : nullptr;
    if (!index) return std::nullopt;
    const git_index_entry *ancestor = nullptr, *ours = nullptr, *theirs = nullptr;
    if (git_index_conflict_get(&ancestor, &ours, &theirs, index.get(), (folder() + path).c_str()) != 0)
        return std::nullopt;
    if (ancestor == nullptr) return "";
    const auto blob = read_git_blob(handle_->repository(), ancestor->id);
    return blob ? std::optional(blob->bytes) : std::nullopt;
}

TrackedFiles GitRepository::tracked_files(const WantsFile& wants) const {
    TrackedFiles out;
    if (!error_.empty()) return {{}, {}, handle_->opened.is_there ? error_.substr(0, error_.find('\n')) : "", false};
    const OwnedIndex index = git_index_of(handle_->repository());
    if (!index) return {{}, {}, "the index cannot be read: " + git_last_error(), false};
    for (size_t i = 0; i < git_index_entrycount(index.get()); ++i) {
        const git_index_entry& entry = *git_index_get_byindex(index.get(), i);
        const std::string_view path = entry.path;
        if (!path.starts_with(folder())) continue;
        std::string below(path.substr(folder().size()));
        if (!wants(below)) continue;
        if (entry.mode == GIT_FILEMODE_COMMIT) out.modules.emplace(below, git_oid_tostr_s(&entry.id));
        out.files.insert(std::move(below));
    }
    out.is_known = git_index_entrycount(index.get()) > 0;
    return out;
}

namespace {

/// Reads one entry of an index, under the path that it is shown with.
void add_index_entry(const Walk& walk, const git_index_entry& entry, const std::string& path) {
    if (entry.mode == GIT_FILEMODE_COMMIT) {
        read_submodule(walk, entry.id, path);
        return;
    }
    const std::string name = walk.name_of(path);
    if (!walk.wants(name)) return;
    if (git_index_entry_stage(&entry) != 0)
        walk.out.error = terminal_text(name) + ": a merge conflict is not resolved\nResolve it and run: git add " +
                         terminal_text(shell_quoted(name)) + "; or check without --staged";
    else if (entry.mode == GIT_FILEMODE_LINK)
        add_linked(walk, path);
    else
        add_blob(walk, entry.id, name);
}

/// Reads what an index has below a folder, "" for all of it.
void add_index_folder(const Walk& walk, git_index* index, const std::string& folder) {
    size_t i = 0;
    if (!folder.empty() && git_index_find_prefix(&i, index, folder.c_str()) != 0) return;
    for (; i < git_index_entrycount(index) && walk.out.error.empty(); ++i) {
        const git_index_entry* entry = git_index_get_byindex(index, i);
        const std::string path = entry->path;
        if (!path.starts_with(folder)) return;
        const std::string shown = walk.alias.empty() ? path : walk.alias + "/" + path.substr(folder.size());
        if (shown.starts_with(walk.prefix)) add_index_entry(walk, *entry, shown);
    }
}

}  // namespace

GitFiles GitRepository::files_in_index(const WantsFile& wants, const std::vector<std::string>& folders) const {
    if (!error_.empty()) return {{}, {}, {}, error_};
    GitFiles out;
    git_index* index = nullptr;
    const std::string of_hook = index_of_hook(handle_->repository());
    if ((of_hook.empty() ? git_repository_index(&index, handle_->repository())
                         : git_index_open(&index, of_hook.c_str())) != 0)
        return {{}, {}, {}, "the index cannot be read: " + git_last_error() + "\nLook into it with: git status"};
    const OwnedIndex owner(index);
    EntryCount entries("the index");
    uint64_t bytes = 0;
    Walk walk{out, handle_->repository(), folder(), "", wants, folders, entries, bytes, entries_of_index(index)};
    add_index_folder(walk, index, "");
    for_linked_folders(walk, [&](const Walk& aliased, const GitPlace&) {
        add_index_folder(aliased, index, aliased.real.empty() ? "" : aliased.real + "/");
        return true;
    });
    if (!out.error.empty()) out.files.clear();
    return out;
}

}  // namespace porttool
