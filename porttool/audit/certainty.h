// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/audit/audit.h"
#include "porttool/audit/past_walk.h"
#include "porttool/audit/todays_pairs.h"

namespace porttool {

/// What one commit did to one side of a pair and the other lacks.
struct FoundEdit {
    size_t pair = 0;  ///< in TodaysPairs
    float alike = 0;  ///< how much of the pair is alike today
    MissingEdit edit;
};

/// Makes items of them, the most certain first: one for each commit and edit, however many pairs lack it.
std::vector<AuditItem> ranked(std::vector<FoundEdit> found, const WalkedPast& walked, const TodaysPairs& today,
                              const Dialect& dialect);

}  // namespace porttool
