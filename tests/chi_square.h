// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace chi_square {

/// Directions by equal steps of the angle from z and of the one around it.
constexpr int kPolarCells = 24;
constexpr int kTurnCells = 24;
constexpr int kCells = kPolarCells * kTurnCells;
constexpr double kCellArea = std::numbers::pi / kPolarCells * 2.0 * std::numbers::pi / kTurnCells;  // in angles

inline size_t cell_of(double x, double y, double z) {
    const double polar = std::acos(std::clamp(z, -1.0, 1.0)) / std::numbers::pi;
    double turn = std::atan2(y, x) / (2.0 * std::numbers::pi);
    turn -= std::floor(turn);
    return static_cast<size_t>(std::min(kPolarCells - 1, static_cast<int>(polar * kPolarCells)) * kTurnCells +
                               std::min(kTurnCells - 1, static_cast<int>(turn * kTurnCells)));
}

/// Expects counts to be drawn from what was expected of each cell: chi-square within 4 sigma. Cells that expect fewer
/// than ten are taken together.
inline void expect_agreement(std::span<const double> seen, std::span<const double> expected) {
    double chi2 = 0.0, pooled_seen = 0.0, pooled_expected = 0.0;
    int freedom = -1;
    for (size_t i = 0; i < seen.size(); ++i) {
        if (expected[i] < 10.0) {
            pooled_seen += seen[i];
            pooled_expected += expected[i];
            continue;
        }
        chi2 += (seen[i] - expected[i]) * (seen[i] - expected[i]) / expected[i];
        ++freedom;
    }
    if (pooled_expected > 5.0) {
        chi2 += (pooled_seen - pooled_expected) * (pooled_seen - pooled_expected) / pooled_expected;
        ++freedom;
    } else {
        EXPECT_LT(pooled_seen, 5.0 + pooled_expected + 5.0 * std::sqrt(pooled_expected + 1.0));
    }
    ASSERT_GT(freedom, 0);
    // Wilson and Hilferty: the cube root of chi-square over its freedom is nearly normal.
    const double sigma = std::sqrt(2.0 / (9.0 * freedom));
    EXPECT_LT((std::cbrt(chi2 / freedom) - (1.0 - sigma * sigma)) / sigma, 4.0)
        << "chi-square " << chi2 << " at " << freedom;
}

}  // namespace chi_square
