// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "porttool/judge/judge.h"
#include "porttool/read/target_sets.h"

namespace porttool {

/// A unit of the other side that looks like the counterpart of a new one.
struct Counterpart {
    const UnitState* unit = nullptr;
    float score = 0;      ///< how sure that is, in [0, 1]
    std::string partner;  ///< the id that it is paired with already, or ""
};

/// By the new unit.
using Counterparts = std::map<const UnitState*, Counterpart>;

/// Looks among today's units of the other side for counterparts of new units: first among those that nothing is paired
/// with; what is left over then among all, where a candidate is never certain. What it reads is bounded, so that a
/// change of a few units costs less than a new map. Finds nothing where the case has no files.
/// Where there are several ports, `set` is the one that is looked at.
/// A pair with a side that is gone leaves the other free.
Counterparts find_counterparts(const Case& facts, const std::vector<JudgedPair>& pairs, Side side,
                               const TargetSets& sets, const std::string& set,
                               const std::vector<const UnitState*>& fresh);

}  // namespace porttool
