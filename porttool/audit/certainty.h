// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "porttool/audit/audit.h"
#include "porttool/audit/past_walk.h"
#include "porttool/audit/todays_pairs.h"

namespace porttool {

/// A pair that differs in few statements today.
struct DifferingPair {
    size_t pair = 0;  ///< in TodaysPairs
    float alike = 0;
    std::vector<MissingPlace> places;
    bool is_slip = false;  ///< its place looks like a slip, as sure as `strength` says, whatever else differs
};

/// What one commit did to one side of a pair and the other lacks.
struct FoundEdit {
    size_t pair = 0;  ///< in TodaysPairs
    float alike = 0;  ///< how much of the pair is alike today
    MissingEdit edit;
    bool both_files = false;  ///< the commit edited a unit of the other side's file
};

/// What so many pairs say in two ways that it is a manner of the sides: `i ++` here, `i += WIDTH` there. By the words
/// that the source and the target have of their own.
using Habits = std::set<std::string>;
Habits habits_of(const std::vector<FoundEdit>& found, const std::vector<DifferingPair>& differing, size_t pairs);

/// Items for pairs that differ today, without a commit that tells why; the least certain of all. Habits make none.
std::vector<AuditItem> items_of_today(const std::vector<DifferingPair>& differing, const TodaysPairs& today,
                                      const Habits& habits);

/// Takes in what running both sides has shown.
void take_witness(const DifftestPair& ran, AuditItem& item);

/// Makes items of them, the most certain first: one for each commit and edit, however many pairs lack it. `alike`: of
/// each pair, how much of it is alike today.
std::vector<AuditItem> ranked(std::vector<FoundEdit> found, const WalkedPast& walked, const TodaysPairs& today,
                              const Habits& habits, const std::vector<float>& alike);

}  // namespace porttool
