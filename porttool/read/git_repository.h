// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "porttool/read/source_files.h"

namespace porttool {

/// Files as git has them, by their path relative to the root that was asked for; or why there are none, with a remedy.
struct GitFiles {
    std::map<std::string, std::string> files;
    std::map<std::string, std::string> unreadable = {};  ///< those too large to be read, and why
    /// Paths of which nobody here knows what they hold: submodules that are not checked out, links that lead elsewhere.
    std::set<std::string> unknown = {};
    std::string error = {};
    std::string note = {};  ///< where they are not those of the merge base with the revision that was named
};

/// A submodule by the path that was asked for, and by that without a link in it; no names for none.
struct ModulePath {
    std::string named = {}, real = {};
};

/// What the merge base has of a folder, or why that cannot be told.
struct FolderAtBase {
    std::string error = {};
    bool is_there = false;              ///< it is a folder, maybe behind a link
    std::string path = {};              ///< without a link in it, from the work tree's own folder
    std::set<std::string> marked = {};  ///< itself and the folders above it, as it was asked for, that hold the mark
    ModulePath module = {};             ///< the outermost submodule that it is or lies in
};

/// Whether a path is wanted; others are not read.
using WantsFile = std::function<bool(const std::string& path)>;

struct GitCommit {
    std::string id;    ///< 40 hexadecimal digits
    int64_t time = 0;  ///< of the committer, seconds since 1970
    std::string subject;
};

/// A file whose content differs between two commits; `blob` is empty where it is gone.
struct GitChange {
    std::string path;  ///< relative to the root that was asked for
    std::string blob;
    std::string before = {};  ///< the blob that it had; empty where it is new
};

/// A commit beside the one that it was made from.
struct GitStep {
    GitCommit commit;
    std::string message;  ///< all of it, up to a bound
    std::string parent;   ///< the first one; empty where the commit has none
    size_t parents = 0;
};

/// Commits, each before those that it was made from.
struct GitSteps {
    std::vector<GitStep> steps;
    bool cut = false;  ///< older ones exist, but not here: a shallow clone. The steps that lack a parent are left out
};

/// A chain of first parents from the oldest that is here to the newest.
struct GitChain {
    std::vector<GitCommit> commits;
    bool cut = false;  ///< older ones exist, but not here: a shallow clone
};

/// What a user can do where there is no repository: the start of a sentence that a git command ends.
inline constexpr const char* kReadsCommits = "This command reads commits; see why with";
inline constexpr const char* kChecksWithGit = "Check without --base and --staged, or try";

/// A git repository, opened for reading what lies below a folder of a work tree (or of a submodule, or a linked one),
/// its root: commits, their files, and the index. Paths are relative to the root. Writes nothing. What a commit holds
/// may have been made to hurt: a thousand bytes can stand for a file of gigabytes, or for a billion folders. So a
/// blob's size is asked before it is read, and a question that meets more than kMostEntries entries ends in CannotDo.
class GitRepository {
public:
    explicit GitRepository(const std::string& root, const std::string& remedy = kReadsCommits);
    ~GitRepository();
    GitRepository(const GitRepository&) = delete;
    GitRepository& operator=(const GitRepository&) = delete;

    /// Why nothing can be read, with a remedy; "" if all is well.
    const std::string& error() const { return error_; }
    bool is_shallow() const;
    /// The repository's own folder (`.git`, that of the main work tree): what is kept there is no part of any commit.
    std::string own_folder() const;

    /// The folder of the whole work tree that the root lies in, without a slash at its end.
    std::string work_tree() const;
    /// Where the index of the work tree is.
    std::string index_file() const;
    /// True if the file stands in the work tree and in the index as HEAD has it.
    bool is_as_committed(const std::string& path) const;

    /// The files below a folder ("" for the root), by their paths in it, that a sparse checkout leaves out of the work
    /// tree.
    std::set<std::string> left_out_of(const std::string& folder) const;
    /// What a file of an unfinished merge was where both sides come from, "" where it was not there; none where the
    /// index knows of no merge over it.
    std::optional<std::string> ancestor_in_merge(const std::string& path) const;

    /// Where the root lies in its repository: "sub/folder/", or "" for its root and outside of any repository.
    const std::string& folder() const;

    /// The commit that a revision names, if it is here.
    std::optional<GitCommit> commit(const std::string& revision) const;
    /// True if `older` is `newer` or an ancestor of it, as far as the history is here.
    bool is_ancestor(const std::string& older, const std::string& newer) const;
    /// How many commits `newer` has that `older` has not.
    size_t commits_between(const std::string& older, const std::string& newer) const;
    GitChain first_parents(const std::string& newest) const;
    /// A commit and all that went into it, branches included; without `hidden` and what went into that, unless empty.
    GitSteps steps(const std::string& newest, const std::string& hidden) const;

    /// What changed from one commit to another, in wanted paths; from nothing if `older` is empty. Symbolic links and
    /// submodules are no files. Sorted by path.
    std::vector<GitChange> changes(const std::string& older, const std::string& newer, const WantsFile& wants) const;
    /// The files at merge-base(revision, HEAD); links are followed within it, and submodules that are checked out.
    /// `folders`: those that hold all that is wanted, others are not looked into; none for anywhere. One that lies
    /// behind a link is found there.
    GitFiles files_at_base(const std::string& revision, const WantsFile& wants,
                           const std::vector<std::string>& folders = {}) const;
    /// What merge-base(revision, HEAD) has at the path of a folder ("" for the root), and which of the folders from
    /// there up to the root have a file of the name `mark`.
    FolderAtBase folder_at_base(const std::string& revision, const std::string& path, const std::string& mark) const;
    /// The links of the index, by their paths in the work tree, where merge-base(revision, HEAD) has a folder or a
    /// submodule.
    std::vector<std::string> links_for_folders(const std::string& revision) const;
    /// The files of the index, or of the one that git gave the hook that we run in.
    GitFiles files_in_index(const WantsFile& wants, const std::vector<std::string>& folders = {}) const;
    /// The wanted files that the index names; none, and no error, outside of any repository.
    TrackedFiles tracked_files(const WantsFile& wants) const;
    /// The content of a blob; none if it is not here, as in a partial clone. In place of one that is larger than any
    /// file that is read stand so many NUL bytes that it is refused as a source for its size.
    std::optional<std::string> find_blob(const std::string& id) const;
    /// The same, empty if it is not here.
    std::string blob(const std::string& id) const { return find_blob(id).value_or(std::string()); }

private:
    struct Handle;
    std::unique_ptr<Handle> handle_;
    std::string error_;
};

}  // namespace porttool
