// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/compare_budget.h"

namespace porttool {
namespace {

constexpr size_t kMostWords = 300'000, kMostAgain = 3'000'000;

}  // namespace

std::string CompareBudget::refusal(const BySide<std::string_view>& ids, const CompareSize& size) {
    if (size.longest > kMostWords)
        return "a text has " + std::to_string(size.longest) + " tokens, at most " + std::to_string(kMostWords) +
               " are compared";
    bool known = false;
    for (const Side side : kBothSides) known |= !compared_[side].emplace(ids[side]).second;
    if (known) again_ += size.sum;
    if (again_ > kMostAgain) return "long units stand in too many pairs";
    return {};
}

}  // namespace porttool
