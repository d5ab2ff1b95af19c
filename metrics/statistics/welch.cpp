// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/statistics/welch.h"

#include <cmath>

#include "metrics/statistics/student.h"

namespace metrics {
namespace {

struct MeanOfValues {
    double mean = 0;
    double variance = 0;  ///< of the mean
};

MeanOfValues mean_of(std::span<const double> values) {
    const auto count = static_cast<double>(values.size());
    MeanOfValues result;
    for (const double value : values) result.mean += value / count;
    for (const double value : values) result.variance += (value - result.mean) * (value - result.mean);
    result.variance /= count * (count - 1);
    return result;
}

}  // namespace

MeanDifference mean_difference(std::span<const double> a, std::span<const double> b) {
    const MeanOfValues of_a = mean_of(a), of_b = mean_of(b);
    MeanDifference result{of_a.mean, of_b.mean, std::sqrt(of_a.variance + of_b.variance), 0};
    if (!(result.standard_error > 0)) return result;
    // As shares of their sum, since the squares of small variances would vanish.
    const double sum = of_a.variance + of_b.variance;
    const double share_a = of_a.variance / sum, share_b = of_b.variance / sum;
    result.degrees_of_freedom = 1 / (share_a * share_a / static_cast<double>(a.size() - 1) +
                                     share_b * share_b / static_cast<double>(b.size() - 1));
    return result;
}

double p_value(const MeanDifference& difference, double allowance) {
    const double excess = std::abs(difference.difference()) - allowance;
    if (!(excess > 0)) return 1;
    if (!(difference.degrees_of_freedom > 0)) return 0;
    return student_two_sided(excess / difference.standard_error, difference.degrees_of_freedom);
}

}  // namespace metrics
