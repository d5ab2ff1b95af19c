// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Inside porttool/read only: what a change is held against.
#pragma once

#include <string>

#include "porttool/read/git_open.h"

namespace porttool {

/// The commit that a change is held against, or why there is none.
struct MergeBase {
    git_oid commit{};
    std::string error = {};
    std::string note = {};    ///< where it is not the merge base with the revision
    bool is_unknown = false;  ///< the revision names nothing here, or there is no commit yet
};

/// merge-base(revision, HEAD). In a submodule that the change of the repository around it moves to another commit, or
/// exchanges, it is the commit that the merge base of that repository names: the branches of the submodule are those of
/// whoever chose it.
MergeBase merge_base_with(git_repository* repository, const std::string& revision);

}  // namespace porttool
