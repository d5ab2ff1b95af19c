// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "porttool/judge/finding_list.h"
#include "porttool/judge/judge.h"

namespace porttool {

/// Finds the pairs of which a port says something else, unedited, since a function that is new there has the name of
/// one that it called before from elsewhere:
///
///     now also  float sqrtf(float x) { return x; }
///     as ever   float length(float x, float y) { return sqrtf(x * x + y * y); }
///
/// Where units must have a counterpart, such a function is told as one without (judge/unwatched.h). What was there at
/// the merge base tells what is new: without one nothing is found.
class NewNames {
public:
    /// Both must outlive it.
    NewNames(const Case& facts, FindingList& findings) : facts_(facts), findings_(findings) {}

    /// Adds the findings of a pair. Of several pairs that call one such function the first tells.
    void judge(JudgedPair& pair);

    /// Says in each finding how many more pairs there are. After all pairs.
    void tell_how_many();

private:
    using ByName = std::unordered_multimap<std::string_view, const UnitState*>;
    struct Told {
        std::string fingerprint;
        size_t more = 0;
    };

    const ByName& fresh(Side side);
    const UnitState* called(Side side, const UnitState& user, const NormalText& text, size_t at);
    void tell(JudgedPair& pair, Side side, const UnitState& unit);

    const Case& facts_;
    FindingList& findings_;
    BySide<std::optional<ByName>> fresh_;  ///< units under names that no unit had at the merge base
    std::map<const UnitState*, Told> told_;
};

}  // namespace porttool
