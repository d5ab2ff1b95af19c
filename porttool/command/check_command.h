// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "porttool/command/commands.h"
#include "porttool/judge/judge.h"
#include "porttool/judge/lock_store.h"

namespace porttool {

/// A project with everything that its judgement rests on. The judgement points into the states: keep them together.
struct CheckedProject {
    Project project;
    LockFile lock;
    std::map<std::string, std::string> texts;  ///< by print: those behind the lock that portmap.base/ does not have
    States states;
    std::vector<PlacedSuppression> suppressions;
    Judgement judgement;
};

/// Reads, scans and judges. Throws CannotDo.
CheckedProject check_project(const Options& options, Workplace& place);

/// YYYY-MM-DD; SOURCE_DATE_EPOCH overrides the clock.
std::string today();

}  // namespace porttool
