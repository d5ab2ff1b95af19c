// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "porttool/read/disk.h"
#include "porttool/snapshot/project.h"
#include "porttool/sync/propose.h"

namespace porttool {

/// A file that proposals write, and where.
struct WrittenFile {
    TreePath place;
    std::string before;  ///< "" for one that is new
    std::string now;
};

/// The files of proposals with the roots that they lie beneath.
std::vector<WrittenFile> written_files(const ProposedFiles& files, const Project& project);

/// Throws where a file is a link, or is reached through one.
void require_no_links(const std::vector<WrittenFile>& files, const Disk& disk);

/// Throws CannotDo for a file that is closed to writing, that is not any more what the proposals were made for, or,
/// unless forced, that holds what no commit does.
void require_applicable(const std::vector<WrittenFile>& files, bool force, const Disk& disk);

/// Writes all of them, or none. `root`: of the project. Throws CannotDo, as above too.
void apply(const std::vector<WrittenFile>& files, const std::string& root, bool force, Disk& disk);

}  // namespace porttool
