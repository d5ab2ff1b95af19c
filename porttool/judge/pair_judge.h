// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "porttool/compare/compare_pair.h"
#include "porttool/judge/finding_list.h"
#include "porttool/judge/judge.h"
#include "porttool/judge/lock_index.h"
#include "porttool/judge/one_sided_weight.h"
#include "porttool/judge/resolve.h"
#include "porttool/judge/shared_files.h"
#include "porttool/judge/swept_names.h"
#include "porttool/judge/two_sided_weight.h"

namespace porttool {

/// Finds what there is to find on one pair after another.
class PairJudge {
public:
    /// All must outlive it.
    PairJudge(const Case& facts, const BySide<RenamedNames>& renamed, SharedFiles& shared_files, FindingList& findings);

    /// Judges the pair of the map whose ids lead to `units` and to that line of the lock; adds its findings.
    JudgedPair judge(const BySide<std::string>& id, int map_line, const BySide<Resolved>& units, const FoundLock& lock);

    /// What edits are compared with.
    const Dialect& dialect() const { return dialect_; }

    /// True if the pair that was judged last is in step because the edit of one side is the port of the other's.
    bool found_one_edit() const { return found_one_edit_; }

private:
    /// A recorded unit in a file that cannot be read is not gone, nor has it moved to where a copy of it stands: it may
    /// have been changed in any way. False if none is.
    bool report_unread_file(const JudgedPair& pair, const BySide<Resolved>& units, bool is_recorded);
    /// Why the file of an id could not be read, or "".
    std::string unread_reason(const std::string& id) const;

    void examine(JudgedPair& pair, const LockedPair* lock);
    void report_gone(const JudgedPair& pair, bool is_recorded);
    void weaken_if_shared(const JudgedPair& pair, size_t first);
    void weaken_if_gone_before(const JudgedPair& pair, size_t first);
    std::string call_in_place_of(const std::string& gone) const;
    void report_moved(const JudgedPair& pair, Side side);

    /// Both sides are there and recorded: what their edits mean to each other.
    void compare(JudgedPair& pair, const LockedPair& lock);
    void report_hazards(const JudgedPair& pair, const PairComparison& found);
    void report_idle(const JudgedPair& pair, const PairComparison& found);
    void report_uncompared(const JudgedPair& pair, const PairComparison& found);
    void report_values(const JudgedPair& pair, const PairComparison& found);
    void report_one(JudgedPair& pair, const PairComparison& found, const BySide<NormalText>& before);
    void report_both(const JudgedPair& pair, const PairComparison& found, const BySide<NormalText>& before);

    const Case& facts_;
    const BySide<RenamedNames>& renamed_;
    FindingList& findings_;
    Dialect dialect_;
    CompareBudget budget_;
    bool found_one_edit_ = false;
    OwnNames own_names_;
    SweptNames swept_names_;
    OneSidedWeight one_sided_;
    TwoSidedWeight two_sided_;
    SharedFiles& shared_files_;
    std::map<std::string, std::string> unread_;  ///< files, and why
};

}  // namespace porttool
