// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "porttool/read/git_repository.h"
#include "porttool/read/map_file.h"
#include "porttool/read/source_glob.h"
#include "porttool/snapshot/project.h"

namespace porttool {

/// A repository whose past is looked at, with the map of today, if there is one.
struct Past {
    std::string root;
    std::unique_ptr<GitRepository> git;
    bool has_map_today = false;
    bool map_is_given = false;  ///< by --config: it counts for every commit
    MapFile map_today;
    std::string map_name;  ///< as messages name it
};

/// Opens the repository around `-C`. Throws CannotDo: no git repository, a map that cannot be read.
Past open_past(const ProjectChoice& choice, Workplace& place);

/// A commit by the revision that an option gave. Throws CannotDo for an unknown one, with what is known instead.
GitCommit find_commit(const Past& past, const std::string& option, const std::string& revision);

/// The content of a file at some commit. Throws CannotDo where the clone lacks it.
std::string read_blob(const Past& past, const std::string& path, const std::string& blob);

/// Throws CannotDo for a map that history cannot use: without sides, or with a target in another repository.
void require_sides(const MapFile& map, const std::string& where);

}  // namespace porttool
