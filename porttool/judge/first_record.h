// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The first lock of a project, for init.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/match/match_sets.h"
#include "porttool/snapshot/lock_store.h"

namespace porttool {

/// Pairs that were found, recorded as in step; what was left over on the source's side is the baseline, of each port.
LockFile first_lock(const SetMatching& matching, const States& states, const TargetSets& sets);

/// The same of the pairs that a map names, as far as both units are there; what is left over on the sides that are its
/// contract is the baseline.
LockFile first_lock(const MapFile& map, const States& states);

/// The lines of the baseline for the units of a side that is the contract. `paired`: of those in pairs, by id, the
/// ports that they are paired with.
std::vector<LockedUnit> baseline_of(const UnitsById& units, Side side,
                                    const std::map<std::string, std::set<std::string>>& paired, const TargetSets& sets);

/// The units that a map pairs, by id, with the ports that they are paired with.
BySide<std::map<std::string, std::set<std::string>>> paired_units(const MapFile& map, const TargetSets& sets);

/// A lock's first pairs are in step by definition. Of those whose constants or fields certainly differ the ledger keeps
/// that they were taken over as they are. Returns these, "SOURCE = TARGET: how they differ".
std::vector<std::string> accept_differences(LockFile& lock, const States& states, const Dialect& dialect,
                                            const std::string& today);

}  // namespace porttool
