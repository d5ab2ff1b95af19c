// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The first lock of a project, for init.
#pragma once

#include <string>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/match/match.h"
#include "porttool/snapshot/lock_store.h"

namespace porttool {

/// Pairs that were found, recorded as in step; what was left over on the source's side is the baseline.
LockFile first_lock(const Matching& matching, const States& states);

/// The same of the pairs that a map names, as far as both units are there; what is left over on the sides that are its
/// contract is the baseline.
LockFile first_lock(const MapFile& map, const States& states);

/// A lock's first pairs are in step by definition. Of those whose constants or fields certainly differ the ledger keeps
/// that they were taken over as they are. Returns these, "SOURCE = TARGET: how they differ".
std::vector<std::string> accept_differences(LockFile& lock, const States& states, const Dialect& dialect,
                                            const std::string& today);

}  // namespace porttool
