// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

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
};

/// What one commit did to one side of a pair and the other lacks.
struct FoundEdit {
    size_t pair = 0;  ///< in TodaysPairs
    float alike = 0;  ///< how much of the pair is alike today
    MissingEdit edit;
};

/// Items for pairs that differ today, without a commit that tells why; the least certain of all.
std::vector<AuditItem> items_of_today(const std::vector<DifferingPair>& differing, const TodaysPairs& today);

/// Takes in what running both sides has shown.
void take_witness(const DifftestPair& ran, AuditItem& item);

/// Makes items of them, the most certain first: one for each commit and edit, however many pairs lack it.
std::vector<AuditItem> ranked(std::vector<FoundEdit> found, const WalkedPast& walked, const TodaysPairs& today);

}  // namespace porttool
