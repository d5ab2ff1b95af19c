// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "porttool/judge/finding_list.h"
#include "porttool/judge/judge.h"
#include "porttool/judge/suppression_index.h"

namespace porttool {

/// What people said of findings: in the lock's ledger and baseline, in comments in the code, in [[ignore]] of the map.
class Verdicts {
public:
    /// Both must outlive it.
    Verdicts(const Case& facts, FindingList& findings);

    /// Lets it settle the findings of a pair, which are those from `first` on. Defer or Ignore where the pair counts as
    /// that. A verdict on a pair in step, and a deferral that has expired, are findings themselves. `drifted_before`:
    /// the pair had drifted at the merge base already, of which nothing is told here, and which a verdict may well
    /// settle.
    std::optional<Verdict> settle(const JudgedPair& pair, size_t first, bool drifted_before);

    /// The same for the finding of a unit without a counterpart, the last of the list. `baseline` is the line that
    /// excuses the unit, or nullptr: one that is excused, or that an [[ignore]] names, has a finding only where a
    /// reason is given, for the reports that list those.
    void settle_lone(const UnitState& unit, Side side, const LockedUnit* baseline);

    /// True for a unit that an [[ignore]] names.
    bool is_ignored(const UnitState& unit) const { return ignored_.contains(unit.id); }
    /// True where a person deferred or ignored that pair.
    bool knows(const JudgedPair& pair) const { return !entries_of(pair.id.source, pair.id.target).empty(); }

    /// Adds findings for comments and [[ignore]]s that settle nothing; after all others.
    void report_idle();

private:
    /// The verdicts on a pair, or on a unit without one (the other side empty).
    const std::vector<const LedgerEntry*>& entries_of(const std::string& source, const std::string& target) const;

    /// Lets comments settle findings from `first` on; true if they settle some and leave none open but notes.
    bool suppress(size_t first);

    void find_ignored();
    void report_idle_comments();
    void report_idle_ignores();

    const Case& facts_;
    FindingList& findings_;
    std::map<std::pair<std::string, std::string>, std::vector<const LedgerEntry*>> ledger_;  ///< without acceptances
    SuppressionIndex suppressions_;
    std::unordered_set<std::string_view> ignored_;  ///< ids of units that an [[ignore]] names
    std::vector<bool> idle_ignores_;
};

}  // namespace porttool
