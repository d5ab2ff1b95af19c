// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/portability/reuse.h"

#include <gtest/gtest.h>

namespace reuse_test {
namespace {

using namespace metrics;

TEST(ReuseModel, FollowsThePublishedFormulaOnBothSidesOfTheBreak) {
    // By hand: AAF = 0.4 x 10 + 0.3 x 20 + 0.3 x 30 = 19; AAM = (4 + 19 (1 + 0.02 x 30 x 0.4)) / 100.
    const ReuseParameters light{10, 20, 30, 4, 30, 0.4, 0};
    EXPECT_DOUBLE_EQ(adaptation_adjustment_factor(light), 19);
    EXPECT_NEAR(equivalent_lines(10000, light), 2756, 1e-9);
    // AAF = 69; AAM = (4 + 69 + 12) / 100.
    const ReuseParameters heavy{60, 80, 70, 4, 30, 0.4, 0};
    EXPECT_NEAR(equivalent_lines(10000, heavy), 8500, 1e-9);
    // A quarter is translated by a program and costs no person's time here.
    const ReuseParameters translated{60, 80, 70, 4, 30, 0.4, 25};
    EXPECT_NEAR(equivalent_lines(10000, translated), 6375, 1e-9);
}

TEST(ReuseModel, ReachesTheEndsOfThePublishedWorstCaseCurve) {
    // COCOMO II model definition manual, the figure of nonlinear reuse effects: AA 8, SU 50, UNFM 1.
    EXPECT_DOUBLE_EQ(adaptation_adjustment_modifier({0, 0, 0, 8, 50, 1, 0}), 0.08);
    EXPECT_DOUBLE_EQ(adaptation_adjustment_modifier({50, 50, 50, 8, 50, 1, 0}), 1.08);
    EXPECT_DOUBLE_EQ(adaptation_adjustment_modifier({100, 100, 100, 8, 50, 1, 0}), 1.58);
    // And the best case, AA 0, UNFM 0, is the straight line.
    EXPECT_DOUBLE_EQ(adaptation_adjustment_modifier({100, 100, 100, 0, 10, 0, 0}), 1);
}

TEST(ReuseModel, TurnsIntoADegreeOfPortability) {
    // 100 lines, 60 shared: CM = IM = 40, AAF = 24; AAM = (4 + 24 (1 + 0.02 x 30 x 0.4)) / 100 = 0.3376.
    const Figure figure = *degree_from_reuse({100, 60, 50, 70});
    EXPECT_NEAR(figure.value, 1 - 0.3376, 1e-12);
    EXPECT_NEAR(figure.low, 1 - (8 + 30 * 2) / 100.0, 1e-12);  // CM = IM = 50, SU 50, UNFM 1
    EXPECT_NEAR(figure.high, 1 - 18 / 100.0, 1e-12);           // CM = IM = 30
}

TEST(ReuseModel, KeepsWhatAProjectHasSettledOutOfTheInterval) {
    ReuseSettings settled;
    settled.assessment = 0;
    settled.understanding = 10;
    settled.unfamiliarity = 0;
    settled.integration = 100;
    const Figure figure = *degree_from_reuse({100, 60, 60, 60}, settled);
    EXPECT_NEAR(figure.value, 1 - (0.3 * 40 + 0.3 * 100) / 100, 1e-12);
    EXPECT_DOUBLE_EQ(figure.low, figure.value);
    EXPECT_DOUBLE_EQ(figure.high, figure.value);
}

TEST(ReuseModel, SaysThatAStrangePortIsDearerThanNewCode) {
    ReuseSettings strange;
    strange.unfamiliarity = 1;
    strange.understanding = 50;
    strange.design_modified = 100;
    EXPECT_LT(degree_from_reuse({100, 0, 0, 0}, strange)->value, 0);
    EXPECT_FALSE(degree_from_reuse({0, 0, 0, 0}));
}

}  // namespace
}  // namespace reuse_test
