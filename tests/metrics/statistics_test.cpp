// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "metrics/statistics/sidak.h"
#include "metrics/statistics/student.h"
#include "metrics/statistics/welch.h"

namespace statistics_test {
namespace {

using namespace metrics;

TEST(IncompleteBeta, HasItsClosedForms) {
    for (const double x : {1e-9, 0.01, 0.3, 0.5, 0.9, 0.999}) {
        EXPECT_NEAR(incomplete_beta(3.7, 1, x) / std::pow(x, 3.7), 1, 1e-12) << x;
        EXPECT_NEAR(incomplete_beta(1, 2.3, x) / -std::expm1(2.3 * std::log1p(-x)), 1, 1e-12) << x;
        EXPECT_NEAR(incomplete_beta(0.5, 0.5, x), 2 / std::numbers::pi * std::asin(std::sqrt(x)), 1e-13) << x;
        EXPECT_NEAR(incomplete_beta(4.2, 11.1, x) + incomplete_beta(11.1, 4.2, 1 - x), 1, 1e-13) << x;
    }
}

// One degree of freedom is Cauchy's distribution, two are 1 - t / sqrt(2 + t^2), without end the normal distribution.
TEST(Student, HasItsClosedFormsFarOutInTheTail) {
    for (const double t : {0.1, 1.0, 5.0, 40.0, 1e6}) {
        EXPECT_NEAR(student_two_sided(t, 1) / (2 / std::numbers::pi * std::atan(1 / t)), 1, 1e-11) << t;
        const double root = std::sqrt(2 + t * t);
        EXPECT_NEAR(student_two_sided(t, 2) / (2 / (root * (root + t))), 1, 1e-11) << t;
    }
    EXPECT_NEAR(student_two_sided(5, 1e9) / std::erfc(5 / std::numbers::sqrt2), 1, 1e-6);
    EXPECT_EQ(student_two_sided(0, 7), 1);
    EXPECT_EQ(student_two_sided(-3, 7), student_two_sided(3, 7));
    EXPECT_EQ(student_two_sided(std::numeric_limits<double>::infinity(), 7), 0);
    for (const double p : {0.2, 1e-3, 1e-9})
        EXPECT_NEAR(student_two_sided(student_critical(p, 17.3), 17.3) / p, 1, 1e-9);
}

TEST(StudentQuantile, AgreesWithThePublishedTable) {
    EXPECT_NEAR(student_quantile(0.975, 1), 12.706, 5e-4);
    EXPECT_NEAR(student_quantile(0.975, 2), 4.303, 5e-4);
    EXPECT_NEAR(student_quantile(0.975, 5), 2.571, 5e-4);
    EXPECT_NEAR(student_quantile(0.975, 8), 2.306, 5e-4);
    EXPECT_NEAR(student_quantile(0.95, 30), 1.697, 5e-4);
    EXPECT_NEAR(student_quantile(0.025, 5), -2.571, 5e-4);
}

TEST(Sidak, SplitsAndJoins) {
    EXPECT_NEAR(sidak_level(0.05, 2), 1 - std::sqrt(0.95), 1e-15);
    EXPECT_NEAR(std::pow(1 - sidak_level(0.001, 500), 500), 0.999, 1e-12);
    EXPECT_NEAR(sidak_p_value(sidak_level(0.001, 3000), 3000), 0.001, 1e-15);
    EXPECT_NEAR(sidak_p_value(1e-300, 10), 1e-299, 1e-310);
    EXPECT_EQ(sidak_p_value(1, 10), 1);
}

// An example often printed: equal sizes, unequal spread; t = 2.46 with 24.99 degrees of freedom, P = 0.021.
TEST(Welch, GivesThePublishedExample) {
    const std::vector<double> a = {27.5, 21.0, 19.0, 23.6, 17.0, 17.9, 16.9, 20.1,
                                   21.9, 22.6, 23.1, 19.6, 19.0, 21.7, 21.4};
    const std::vector<double> b = {27.1, 22.0, 20.8, 23.4, 23.4, 23.5, 25.8, 22.0,
                                   24.8, 20.2, 21.9, 22.1, 22.9, 20.5, 24.4};
    const MeanDifference means = mean_difference(a, b);
    EXPECT_NEAR(means.difference() / means.standard_error, 2.46, 5e-3);
    EXPECT_NEAR(means.degrees_of_freedom, 24.99, 5e-3);
    EXPECT_NEAR(p_value(means), 0.021, 5e-4);
    EXPECT_EQ(p_value(means, 3), 1) << "within the allowance";
}

TEST(Welch, KnowsWhatDoesNotScatter) {
    const std::vector<double> a = {2, 2, 2}, b = {2.5, 2.5};
    EXPECT_EQ(p_value(mean_difference(a, a)), 1);
    EXPECT_EQ(p_value(mean_difference(a, b)), 0);
    EXPECT_EQ(p_value(mean_difference(a, b), 0.6), 1);
}

}  // namespace
}  // namespace statistics_test
