// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Inside porttool/read only: where a path of a commit or an index leads to.
#pragma once

#include <functional>
#include <string>

#include "porttool/read/git_open.h"

namespace porttool {

/// What stands at a path of a commit or an index.
struct GitEntry {
    enum class Kind : uint8_t { None, File, Link, Folder, Submodule };
    Kind kind = Kind::None;
    git_oid id = {};  ///< of a folder in an index none
};

/// Where a path leads to.
struct GitPlace {
    std::string path;  ///< without a link in it
    GitEntry entry;
    bool by_link = false;
    bool is_elsewhere = false;  ///< out of the repository, or in a submodule of it
};

/// Asks a commit or an index what stands at a path, without following links.
using GitEntryAt = std::function<GitEntry(const std::string& path)>;

/// What stands at a path of a commit.
GitEntryAt entries_of_tree(const git_tree* tree);

/// What stands at a path of an index.
GitEntryAt entries_of_index(git_index* index);

/// Follows the links in each part of a path, as a work tree does. Each step counts.
GitPlace follow_git_links(git_repository* repository, const GitEntryAt& at, EntryCount& steps, const std::string& path);

}  // namespace porttool
