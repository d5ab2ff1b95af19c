// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/statistics/student.h"

#include <cmath>
#include <initializer_list>
#include <limits>

namespace metrics {
namespace {

/// The continued fraction of DLMF 8.17.22, which converges fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
    constexpr double kTiny = 1e-300, kPrecise = 1e-15;
    constexpr int kMostSteps = 10000;
    const auto kept_off_zero = [](double value) { return std::abs(value) < kTiny ? kTiny : value; };
    double c = 1, d = 1 / kept_off_zero(1 - (a + b) * x / (a + 1));
    double fraction = d;
    for (int m = 1; m < kMostSteps; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        double step = 1;
        for (const double coefficient : {even, odd}) {
            d = 1 / kept_off_zero(1 + coefficient * d);
            c = kept_off_zero(1 + coefficient / c);
            step = c * d;
            fraction *= step;
        }
        if (std::abs(step - 1) < kPrecise) break;
    }
    return fraction;
}

}  // namespace

double incomplete_beta(double a, double b, double x) {
    if (!(x > 0)) return 0;
    if (x >= 1) return 1;
    const double front =
        std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
    return x < (a + 1) / (a + b + 2) ? front * beta_fraction(a, b, x) / a : 1 - front * beta_fraction(b, a, 1 - x) / b;
}

double student_two_sided(double t, double degrees_of_freedom) {
    if (std::isinf(t)) return 0;
    return incomplete_beta(0.5 * degrees_of_freedom, 0.5, degrees_of_freedom / (degrees_of_freedom + t * t));
}

double student_critical(double p_value, double degrees_of_freedom) {
    double low = 0, high = 1;
    while (student_two_sided(high, degrees_of_freedom) > p_value && high < std::numeric_limits<double>::max() / 4)
        high *= 2;
    constexpr int kHalvings = 100;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        (student_two_sided(middle, degrees_of_freedom) > p_value ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double student_quantile(double probability, double degrees_of_freedom) {
    if (probability < 0.5) return -student_quantile(1 - probability, degrees_of_freedom);
    return student_critical(2 * (1 - probability), degrees_of_freedom);
}

}  // namespace metrics
