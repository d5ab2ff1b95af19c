// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/judge/resolve.h"
#include "porttool/judge/verdicts.h"

namespace porttool {

/// Notes the units that no pair leads to, on the sides that are the contract, and counts them. Those that are new and
/// that nothing excuses are findings: `unpaired` where the other side has a likely counterpart, else `unported`.
void find_unwatched(const Case& facts, const BySide<const Resolver*>& resolvers, FindingList& findings,
                    Verdicts& verdicts, Judgement& out);

}  // namespace porttool
