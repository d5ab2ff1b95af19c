// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Inside porttool/read only: what its users of libgit2 share.
#pragma once

#include <git2.h>

#include <memory>
#include <optional>
#include <string>

#include "porttool/read/git_repository.h"
#include "porttool/read/source_files.h"

namespace porttool {

/// Frees a libgit2 object with the function that its type asks for.
template <class T, void (*Free)(T*)>
struct GitFreed {
    void operator()(T* object) const { Free(object); }
};
template <class T, void (*Free)(T*)>
using GitOwned = std::unique_ptr<T, GitFreed<T, Free>>;
using OwnedRepository = GitOwned<git_repository, git_repository_free>;
using OwnedObject = GitOwned<git_object, git_object_free>;
using OwnedCommit = GitOwned<git_commit, git_commit_free>;
using OwnedTree = GitOwned<git_tree, git_tree_free>;
using OwnedIndex = GitOwned<git_index, git_index_free>;

/// What has this id, and what belongs to a commit or a repository; nullptr where libgit2 failed, which says why.
OwnedCommit git_commit_at(git_repository* repository, const git_oid& id);
OwnedTree git_tree_at(git_repository* repository, const git_oid& id);
OwnedTree git_tree_of(const git_commit* commit);
OwnedIndex git_index_of(git_repository* repository);

/// Throws CannotDo where libgit2 failed in this thread since it asked for more memory than any object that is read may
/// have. For whoever takes a failure for an answer: what is too large is here.
void tell_refused_object();

/// What libgit2 says of its last failure. Throws std::bad_alloc where that was a lack of memory, and as above.
std::string git_last_error();

/// A repository with its work tree's path to the root in question.
struct OpenedGit {
    OwnedRepository repository;
    std::string prefix;     ///< "sub/folder/" or ""
    std::string error;      ///< empty, or why not, with `remedy` and the git command that helps
    bool is_there = false;  ///< one lies there, whether it can be read or not
};

struct GitRepository::Handle {
    OpenedGit opened;
    git_repository* repository() const { return opened.repository.get(); }
};

/// The longest path of a work tree; a made-up commit may nest deeper, and that is no file.
inline constexpr size_t kLongestGitPath = 4096;

/// What a blob holds, or that it is too large to be read: then `bytes` is empty.
struct GitBlob {
    std::string bytes;
    uint64_t size = 0;
};

/// Reads a blob of at most kLargestFile bytes, of others only the size; none if it is not here.
std::optional<GitBlob> read_git_blob(git_repository* repository, const git_oid& id);

/// Counts the entries of trees that one question meets. Throws CannotDo beyond kMostEntries.
class EntryCount {
public:
    /// `where`: what has them, as the message calls it.
    explicit EntryCount(std::string where) : where_(std::move(where)) {}
    void add(size_t entries);

private:
    std::string where_;
    size_t met_ = 0;
};

/// The id that 40 hexadecimal digits name.
std::optional<git_oid> git_oid_of(const std::string& digits);

/// The repository of a `.git` entry (a folder, or the file of a submodule or a linked work tree), or nullptr.
git_repository* open_work_tree(const std::string& git_entry);

/// Opens the repository that a folder of a work tree lies in (also a submodule, or a linked work tree).
OpenedGit open_git(const std::string& root, const std::string& remedy);

}  // namespace porttool
