// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "porttool/audit/lineage.h"
#include "porttool/language/dialect.h"
#include "porttool/read/git_repository.h"

namespace porttool {

/// The units that are followed, by id.
using Lineages = std::map<std::string, UnitLineage>;

struct WalkedPast {
    std::vector<GitStep> steps;   ///< newest first; LineageStep::commit is a place in here
    std::vector<uint32_t> units;  ///< of each step, how many of the followed units it edited
    bool cut = false;             ///< a shallow clone: what its oldest commits did is not known
    size_t not_read = 0;          ///< versions of files that could not be had or read
};

/// Walks from HEAD through all commits that are no merges, branches included, newest first, and tells the lineages what
/// each did. Files that were renamed, and units that were renamed or moved in the commit, are followed.
/// `hidden`: a commit; it and what went into it is left out. `since`: seconds since 1970, older ones are left out.
WalkedPast walk_past(const std::string& root, const std::string& head, const std::string& hidden, int64_t since,
                     const Dialect& dialect, Lineages& lineages);

}  // namespace porttool
