// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "porttool/judge/judgement.h"

namespace porttool {

/// Which of the open findings of one look are not those of the look before, and which of those are gone.
struct FindingChanges {
    std::vector<const Finding*> fresh;  ///< new ones, and known ones that say something else now
    std::vector<const Finding*> gone;
    bool empty() const { return fresh.empty() && gone.empty(); }
};

/// Whether a finding whose lines alone moved is one that changed.
enum class Moves : uint8_t { Count, Pass };

/// Findings are known by their fingerprints. Both lists must outlive the result.
FindingChanges changes_between(const std::vector<Finding>& before, const std::vector<Finding>& now, Moves moves);

}  // namespace porttool
