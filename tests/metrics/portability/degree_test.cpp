// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/portability/degree.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace degree_test {
namespace {

using namespace metrics;

double in_lines(double lines, double shared) { return degree_from_lines({lines, shared, shared, shared})->value; }

TEST(DegreeOfPortability, GivesTheBlocksOfTheThesis) {
    // Table 2: lines of the CPU core and how many of them are shared.
    EXPECT_DOUBLE_EQ(in_lines(100, 73), 0.73);
    EXPECT_NEAR(in_lines(216, 101), 0.47, 0.005);
    EXPECT_NEAR(in_lines(2007, 181), 0.09, 0.005);
    EXPECT_DOUBLE_EQ(in_lines(43, 0), 0);
}

TEST(DegreeOfPortability, IsNegativeWhereThePortIsDearer) {
    EXPECT_DOUBLE_EQ(*degree_of_portability(150, 100), -0.5);
    EXPECT_DOUBLE_EQ(*degree_of_portability(0, 100), 1);
}

TEST(DegreeOfPortability, IsNothingWhereNothingWouldBeRedeveloped) {
    EXPECT_EQ(degree_of_portability(0, 0), std::nullopt);
    EXPECT_EQ(degree_of_portability(-1, 10), std::nullopt);
    EXPECT_EQ(degree_of_portability(std::numeric_limits<double>::quiet_NaN(), 10), std::nullopt);
    EXPECT_FALSE(degree_from_lines({0, 0, 0, 0}));
    EXPECT_FALSE(degree_from_hours({}));
}

TEST(DegreeOfPortability, SpansTheReadingsOfWhatIsShared) {
    const Figure figure = *degree_from_lines({200, 120, 60, 150});
    EXPECT_DOUBLE_EQ(figure.value, 0.6);
    EXPECT_DOUBLE_EQ(figure.low, 0.3);
    EXPECT_DOUBLE_EQ(figure.high, 0.75);
    EXPECT_EQ(figure.model, "lines");
    ASSERT_EQ(figure.inputs.size(), 2u);
    EXPECT_EQ(figure.inputs[0].unit, "lines");
}

TEST(DegreeOfPortability, WeighsComponentsAndLeavesDesignOutOfThePort) {
    // 100 lines, 60 shared. Redevelopment: 100 x (2 + 3 + 4 + 1) = 1000. Port: 40 x 3 + 4 x (40 + 0.5 x 60) + 40 x 1.
    const LineWeights weights{2, 3, 4, 1, 0.5};
    EXPECT_DOUBLE_EQ(redevelopment_from_lines(100, weights).total(), 1000);
    EXPECT_DOUBLE_EQ(port_from_lines(100, 60, weights).total(), 120 + 280 + 40);
    EXPECT_DOUBLE_EQ(degree_from_lines({100, 60, 60, 60}, weights)->value, 0.56);
}

TEST(DegreeOfPortability, PoolsTheHoursOfALedger) {
    // 6 of 20 hours and 9 of 10: pooled 1 - 15 / 30, each for itself 0.7 and 0.1.
    const std::array<RecordedCost, 2> ledger = {{{{3, 2, 1}, {8, 6, 4, 2}, 0}, {{5, 3, 1}, {2, 5, 2, 1}, 0}}};
    const Figure figure = *degree_from_hours(ledger);
    EXPECT_DOUBLE_EQ(figure.value, 0.5);
    EXPECT_DOUBLE_EQ(figure.low, 0.1);
    EXPECT_DOUBLE_EQ(figure.high, 0.7);
}

TEST(DegreeOfPortability, CarriesTheUncertaintyOfARecord) {
    // 5 of 10 hours, each known to 10 %: 1 - 5.5 / 9 and 1 - 4.5 / 11.
    const std::array<RecordedCost, 1> ledger = {{{{5, 0, 0}, {0, 10, 0, 0}, 0.1}}};
    const Figure figure = *degree_from_hours(ledger);
    EXPECT_DOUBLE_EQ(figure.value, 0.5);
    EXPECT_NEAR(figure.low, 0.388889, 1e-6);
    EXPECT_NEAR(figure.high, 0.590909, 1e-6);
}

}  // namespace
}  // namespace degree_test
