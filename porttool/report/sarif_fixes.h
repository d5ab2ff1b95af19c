// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Proposed ports as SARIF has them, for a viewer's "apply".
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "porttool/sync/propose.h"

namespace porttool {

/// The port of one pair's edit, by the ids of portmap.toml.
struct ProposedFix {
    std::string source, target;
    std::map<std::string, ProposedFile> files;  ///< by their paths as seen from the project's root
};

/// What `sync` proposes as a whole for the pairs with open findings, each as if it were alone: of the first 20 that
/// are out of step. Those that bring pairs with them have none, as a viewer makes no new files.
std::vector<ProposedFix> proposed_fixes(const CheckedProject& checked, const Disk& disk);

/// False where there is nothing to propose: then files need not be scanned for it.
bool any_fix_is_due(const Judgement& judgement);

/// A member of `fixes` (2.1.0, 3.55). None where a text is no UTF-8, or its last line, without an end, changes.
/// `folder`: where the root lies in its repository.
nlohmann::ordered_json sarif_fix(const ProposedFix& fix, const std::string& folder);

}  // namespace porttool
