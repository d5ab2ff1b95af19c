// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/judge/judge.h"
#include "porttool/judge/lock_store.h"

namespace porttool {

/// A project as it was at merge-base(REV, HEAD), with its judgement. The judgement points into the states, and the
/// states into nothing: keep them together.
struct PastProject {
    Project project;
    RecordedLock lock;
    bool is_recorded = false;  ///< there was a lock
    States states;
    Judgement judgement;
};

/// Reads it under today's sides, blocks and dialect, so that figures compare, but with the pairs that its own map
/// named. Throws CannotDo.
void read_past(PastProject& past, const Project& today, const std::string& revision, const std::string& date);

/// The comments of both sides that settle findings.
std::vector<PlacedSuppression> placed_suppressions(const Project& project);

}  // namespace porttool
