// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Inside porttool/read only: what its users of libgit2 share.
#pragma once

#include <git2.h>

#include <memory>
#include <optional>
#include <string>

#include "porttool/read/git_repository.h"

namespace porttool {

/// Frees a libgit2 object with the function that its type asks for.
template <class T, void (*Free)(T*)>
struct GitFreed {
    void operator()(T* object) const { Free(object); }
};
template <class T, void (*Free)(T*)>
using GitOwned = std::unique_ptr<T, GitFreed<T, Free>>;

/// What libgit2 says of its last failure.
std::string git_last_error();

/// A repository with its work tree's path to the root in question.
struct OpenedGit {
    GitOwned<git_repository, git_repository_free> repository;
    std::string prefix;  ///< "sub/folder/" or ""
    std::string error;   ///< empty, or why not, with `remedy` and the git command that helps
};

struct GitRepository::Handle {
    OpenedGit opened;
    git_repository* repository() const { return opened.repository.get(); }
};

/// The id that 40 hexadecimal digits name.
std::optional<git_oid> git_oid_of(const std::string& digits);

/// The repository of a `.git` entry (a folder, or the file of a submodule or a linked work tree), or nullptr.
git_repository* open_work_tree(const std::string& git_entry);

/// Opens the repository that a folder of a work tree lies in (also a submodule, or a linked work tree).
OpenedGit open_git(const std::string& root, const std::string& remedy);

}  // namespace porttool
