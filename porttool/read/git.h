// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>

namespace porttool {

/// Files as git has them, by their path relative to the root that was asked for; or why there are none, with a remedy.
struct GitFiles {
    std::map<std::string, std::string> files;
    std::string error;
};

/// Where `root` lies in its repository: "sub/folder/", or "" for its root and outside of any repository.
std::string folder_in_repository(const std::string& root);

/// Whether a path is wanted; others are not read.
using WantsFile = std::function<bool(const std::string& path)>;

/// The files at merge-base(revision, HEAD), below `root`, a folder of a work tree (or of a submodule, or a linked one).
GitFiles files_at_base(const std::string& root, const std::string& revision, const WantsFile& wants);

/// The wanted files that the index names; none outside of any repository.
std::set<std::string> tracked_files(const std::string& root, const WantsFile& wants);

/// The files of the index.
GitFiles files_in_index(const std::string& root, const WantsFile& wants);

}  // namespace porttool
