// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_set>

#include "porttool/scan/side.h"

namespace porttool {

/// The texts that comparing a pair takes, in words of normal form.
struct CompareSize {
    size_t longest = 0, sum = 0;

    void add(size_t words) {
        longest = std::max(longest, words);
        sum += words;
    }
};

/// Keeps the comparing of one moment's pairs within bounds: units of a length that no person wrote, and a long unit
/// that stands in pair after pair.
class CompareBudget {
public:
    /// Why a pair is not to be compared; "" if it is. `ids`: of its two units.
    std::string refusal(const BySide<std::string_view>& ids, const CompareSize& size);

private:
    BySide<std::unordered_set<std::string>> compared_;
    size_t again_ = 0;  ///< words compared once more for another pair
};

}  // namespace porttool
