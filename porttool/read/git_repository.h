// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "porttool/read/git.h"

namespace porttool {

struct GitCommit {
    std::string id;    ///< 40 hexadecimal digits
    int64_t time = 0;  ///< of the committer, seconds since 1970
    std::string subject;
};

/// A file whose content differs between two commits; `blob` is empty where it is gone.
struct GitChange {
    std::string path;  ///< relative to the root that was asked for
    std::string blob;
};

/// A chain of first parents from the oldest that is here to the newest.
struct GitChain {
    std::vector<GitCommit> commits;
    bool cut = false;  ///< older ones exist, but not here: a shallow clone
};

/// A git repository, opened for reading commits and blobs below a folder of a work tree. Writes nothing.
class GitRepository {
public:
    explicit GitRepository(const std::string& root);
    ~GitRepository();
    GitRepository(const GitRepository&) = delete;
    GitRepository& operator=(const GitRepository&) = delete;

    /// Why nothing can be read, with a remedy; "" if all is well.
    const std::string& error() const { return error_; }
    bool is_shallow() const;
    /// The repository's own folder (`.git`, that of the main work tree): what is kept there is no part of any commit.
    std::string own_folder() const;

    /// The commit that a revision names, if it is here.
    std::optional<GitCommit> commit(const std::string& revision) const;
    /// True if `older` is `newer` or an ancestor of it, as far as the history is here.
    bool is_ancestor(const std::string& older, const std::string& newer) const;
    /// How many commits `newer` has that `older` has not.
    size_t commits_between(const std::string& older, const std::string& newer) const;
    GitChain first_parents(const std::string& newest) const;

    /// What changed from one commit to another, in wanted paths; from nothing if `older` is empty. Symbolic links and
    /// submodules are no files. Sorted by path.
    std::vector<GitChange> changes(const std::string& older, const std::string& newer, const WantsFile& wants) const;
    /// The content of a blob; none if it is not here, as in a partial clone.
    std::optional<std::string> find_blob(const std::string& id) const;
    /// The same, empty if it is not here.
    std::string blob(const std::string& id) const { return find_blob(id).value_or(std::string()); }

private:
    struct Handle;
    std::unique_ptr<Handle> handle_;
    std::string error_;
};

}  // namespace porttool
