// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/judge/shared_files.h"
#include "porttool/judge/verdicts.h"

namespace porttool {

/// Notes the units that no pair leads to, on the sides that are the contract, and counts them. Those that are new and
/// that nothing excuses are findings: `unpaired` where the other side has a likely counterpart, else `unported`.
/// Each port of [sides.targets] is held against the source for itself. After the pairs, which it reads from `out`.
void find_unwatched(const Case& facts, SharedFiles& shared_files, FindingList& findings, Verdicts& verdicts,
                    Judgement& out);

}  // namespace porttool
