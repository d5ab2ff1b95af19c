// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "porttool/audit/pair_reading.h"
#include "porttool/difftest/difftest.h"
#include "porttool/read/git_repository.h"
#include "porttool/snapshot/project.h"

namespace porttool {

/// Of items less certain than this fewer than half were real where that was counted.
inline constexpr double kLikelyItem = 0.45;

/// What a user asks of the audit.
struct AuditChoice : ProjectChoice {
    std::string since;  ///< a revision or a day; may be empty
    size_t limit = 20;
    bool runs = false;  ///< runs both sides of the pairs that are listed: code of the repository
};

/// An edit of one side that today's other side lacks, or where there is no commit to name, a difference of today.
struct AuditItem {
    BySide<std::string> id;
    BySide<uint32_t> line;  ///< where the units stand
    Side edited = Side::Source;
    std::optional<GitCommit> commit;
    std::string summary;   ///< what is missing, in one line
    double certainty = 0;  ///< 0 to 1
    std::vector<MissingPlace> places;
    std::vector<std::string> why;                           ///< what speaks for it and against it
    std::vector<std::pair<std::string, std::string>> same;  ///< other pairs that lack the same edit
    std::string patch;                                      ///< "" for none
    std::optional<Counterexample> witness;
    std::string remedy;
};

struct Audit {
    std::vector<AuditItem> items;  ///< most certain first, at most as many as were asked for
    size_t found = 0;              ///< before the limit
    size_t pairs = 0;
    size_t commits = 0;  ///< read
    bool shallow = false;
    bool squashed = false;  ///< there is one commit
    bool unedited = false;  ///< none that was read edited a unit of either side
};

/// Reads both sides and their past. Throws CannotDo.
Audit audit(const AuditChoice& choice, Workplace& place);

}  // namespace porttool
