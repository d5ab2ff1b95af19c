// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/portability/port_fit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "metrics/portability/power_law.h"

namespace port_fit_test {
namespace {

using namespace metrics;

TEST(LeastSquares, FitsAnscombesFirstSetAsPublished) {
    // F. J. Anscombe, "Graphs in Statistical Analysis", 1973: y = 3.00 + 0.500 x, residual deviation 1.237, standard
    // error of the slope 0.118.
    const std::vector<double> x = {10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
    const std::vector<double> y = {8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68};
    std::vector<std::vector<double>> rows;
    for (const double value : x) rows.push_back({1, value});
    const LinearFit fit = *fit_least_squares(rows, y);
    EXPECT_NEAR(fit.coefficients[0], 3.0001, 1e-4);
    EXPECT_NEAR(fit.coefficients[1], 0.5001, 1e-4);
    EXPECT_NEAR(fit.residual_deviation, 1.237, 5e-4);
    EXPECT_NEAR(standard_error(fit, 1), 0.1179, 1e-4);
    EXPECT_EQ(fit.degrees_of_freedom, 9);
    // At the mean, x = 9, with n = 11: t(9) = 2.262, so 7.501 +- 2.262 x 1.237 x sqrt(1 + 1 / 11).
    const Prediction at_mean = predict(fit, {1, 9});
    EXPECT_NEAR(at_mean.value, 7.501, 1e-3);
    EXPECT_NEAR(at_mean.high - at_mean.value, 2.262 * 1.2366 * std::sqrt(12.0 / 11), 2e-3);
}

std::vector<RecordedPort> ports(size_t count) {
    std::vector<RecordedPort> out;
    for (size_t i = 0; i < count; ++i) {
        const double novel = 10.0 * static_cast<double>(i + 1), carried = 5.0 * static_cast<double>(i * i % 7);
        out.push_back({novel, carried, 2 + 0.25 * novel + 0.05 * carried});
    }
    return out;
}

TEST(PortFit, RefusesBelowEightPorts) {
    const PortFit refused = fit_ports(ports(7));
    EXPECT_FALSE(refused.fit);
    EXPECT_EQ(refused.refusal, "7 ports with hours are recorded; a fit needs at least 8");
    EXPECT_TRUE(fit_ports(ports(8)).fit);
}

TEST(PortFit, RefusesPortsThatAreAllAlike) {
    const std::vector<RecordedPort> alike(9, RecordedPort{10, 5, 3});
    EXPECT_FALSE(fit_ports(alike).fit);
    EXPECT_NE(fit_ports(alike).refusal.find("too alike"), std::string::npos);
}

TEST(PortFit, FindsThePlaneThatMadeTheRecords) {
    const PortFit fit = fit_ports(ports(10));
    const Figure hours = predicted_hours(fit, 100, 40);
    EXPECT_NEAR(hours.value, 2 + 25 + 2, 1e-8);
    EXPECT_NEAR(hours.low, hours.high, 1e-6) << "records without scatter leave no doubt";
    const Figure degree = *degree_from_prediction(hours, 116);
    EXPECT_NEAR(degree.value, 0.75, 1e-9);
}

TEST(PortFit, WidensWithScatterAndStaysAboveZero) {
    std::vector<RecordedPort> scattered = ports(10);
    for (size_t i = 0; i < scattered.size(); ++i) scattered[i].hours += i % 2 == 0 ? 4 : -4;
    const Figure hours = predicted_hours(fit_ports(scattered), 1, 1);
    EXPECT_GE(hours.low, 0);
    EXPECT_GT(hours.high - hours.low, 4);
    EXPECT_LE(hours.low, hours.value);
    EXPECT_LE(hours.value, hours.high);
}

// Ports made by Y = 0.05 x 10^(0.8 alpha_p) x 10^(0.3 alpha_E) x X^1.2, alpha_H the same in all.
std::vector<SizedPort> made_by_law(size_t count) {
    std::vector<SizedPort> out;
    for (size_t i = 0; i < count; ++i) {
        const double lines = 20 + 35 * static_cast<double>(i * i % 11);
        const Impediments alpha{0.1 * static_cast<double>(i % 4), 0.5, 0.2 * static_cast<double>(i % 3)};
        const double hours = 0.05 * std::pow(10, 0.8 * alpha.program + 0.3 * alpha.environment) * std::pow(lines, 1.2);
        out.push_back({lines, alpha, hours, i == 3});
    }
    return out;
}

TEST(PowerLaw, FindsTheLawThatMadeTheRecords) {
    std::vector<SizedPort> ports = made_by_law(12);
    ports.push_back({0, {}, 3});
    const PowerLaw law = fit_power_law(ports);
    ASSERT_TRUE(law.fit) << law.refusal;
    EXPECT_EQ(law.ports, 12u) << "without lines there is no logarithm";
    EXPECT_EQ(law.mined, 1u);
    EXPECT_EQ(law.told, (std::array<bool, 3>{true, false, true})) << "alpha_H is a part of C";
    EXPECT_NEAR(law.fit->coefficients[1], 1.2, 1e-9);
    const Figure hours = predicted_hours(law, 100, {0.3, 0.5, 0.4});
    EXPECT_NEAR(hours.value, 0.05 * std::pow(10, 0.24 + 0.12) * std::pow(100, 1.2), 1e-6);
    EXPECT_NEAR(hours.high / hours.low, 1, 1e-6) << "records without scatter leave no doubt";
}

TEST(PowerLaw, ScatterMakesAnIntervalOfFactors) {
    std::vector<SizedPort> ports = made_by_law(12);
    for (size_t i = 0; i < ports.size(); ++i) ports[i].hours *= i % 2 == 0 ? 1.5 : 1 / 1.5;
    const Figure hours = predicted_hours(fit_power_law(ports), 1, {});
    EXPECT_GT(hours.low, 0) << "hours are never negative";
    EXPECT_NEAR(hours.value / hours.low, hours.high / hours.value, 1e-9 * hours.high / hours.value);
    EXPECT_GT(hours.high / hours.low, 2.25);
}

TEST(PowerLaw, TellsHowSureItsCoefficientsAre) {
    // Hours 10, 100, 1000 ... of 1, 10, 100 ... lines, half of them 10 times and half a tenth of that: a line of slope
    // 1 through residuals of +-1 in the logarithm, whose errors are known in closed form.
    std::vector<SizedPort> ports;
    for (int i = 0; i < 4; ++i)
        for (const double factor : {10.0, 0.1, 0.1, 10.0})
            ports.push_back({std::pow(10, i), {}, factor * std::pow(10, i + 1)});
    const Figure hours = predicted_hours(fit_power_law(ports), 10, {});
    std::map<std::string, double> inputs;
    for (const FigureInput& input : hours.inputs) inputs[input.name] = input.value;
    const double deviation = std::sqrt(16.0 / 14), squares = 4 * (2.25 + 0.25 + 0.25 + 2.25);
    EXPECT_NEAR(inputs["beta"], 1, 1e-9);
    EXPECT_NEAR(inputs["standard error of beta"], deviation / std::sqrt(squares), 1e-9);
    EXPECT_NEAR(inputs["C"], 10, 1e-6);
    EXPECT_NEAR(inputs["standard error of C (factor)"], std::pow(10, deviation * std::sqrt(1.0 / 16 + 2.25 / squares)),
                1e-6);
    EXPECT_NEAR(inputs["scatter (factor)"], std::pow(10, deviation), 1e-6);
}

TEST(PowerLaw, RefusesFewPortsAndPortsAllAlike) {
    EXPECT_EQ(fit_power_law(made_by_law(7)).refusal,
              "7 ports with lines and hours are recorded; a fit needs at least 8");
    EXPECT_FALSE(fit_power_law(std::vector<SizedPort>(9, {50, {}, 3})).fit);
}

}  // namespace
}  // namespace port_fit_test
