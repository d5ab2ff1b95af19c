// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Edits of units that have no pair, or whose port is spread over other functions than their counterpart.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "porttool/audit/pair_reading.h"
#include "porttool/audit/past_walk.h"
#include "porttool/snapshot/snapshot.h"

namespace porttool {

/// An edit of one unit whose text from before still stands in a unit of the other side that is not its pair.
struct StrayEdit {
    BySide<std::string> id;
    MissingEdit edit;
    float alike = 0;  ///< share of the smaller unit's statements that both have
};

/// Looks for the text from before of every edit on the whole other side, by statements that say the same there. Such a
/// text counts where it is a rare one, where a neighbour of it stands beside it there, too, and where nothing on the
/// other side says what became of it. `paired`: by source and target, the pairs that are read by themselves.
std::vector<StrayEdit> stray_edits(const Snapshot& snapshot, const Lineages& lineages, const BySide<UsesOnSide>& uses,
                                   const std::set<std::pair<std::string, std::string>>& paired, const Dialect& dialect);

}  // namespace porttool
