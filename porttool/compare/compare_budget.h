// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <unordered_set>

#include "porttool/normal/unit_state.h"

namespace porttool {

/// Keeps the comparing of edits within bounds: units of a length that no person wrote, and a long unit that stands in
/// pair after pair.
class CompareBudget {
public:
    /// Why the edits of a pair are not to be compared; "" if they are. The texts are those before, "" if not known.
    std::string refusal(const UnitState& source, const UnitState& target, const std::string& source_base,
                        const std::string& target_base);

private:
    std::unordered_set<const UnitState*> compared_;
    size_t again_ = 0;  ///< words compared once more for another pair
};

}  // namespace porttool
