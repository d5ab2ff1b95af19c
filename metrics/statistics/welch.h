// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace metrics {

/// How far two means are apart.
struct MeanDifference {
    double mean_a = 0;
    double mean_b = 0;
    double standard_error = 0;      ///< of mean_b - mean_a
    double degrees_of_freedom = 0;  ///< of the standard error; 0: unknown, there are too few values or all are equal

    double difference() const { return mean_b - mean_a; }
};

/// The means of two sets of independent values with the standard error of their difference and its degrees of freedom
/// (B. L. Welch, "The generalization of 'Student's' problem when several different population variances are involved",
/// Biometrika 34, 1947, and Satterthwaite). The sets may differ in size and in spread. Needs two values in each.
MeanDifference mean_difference(std::span<const double> a, std::span<const double> b);

/// The two-sided p-value of a difference of more than `allowance`: that of t = (|difference| - allowance) / error, and
/// 1 within the allowance. Where nothing scatters a larger difference has the p-value 0.
double p_value(const MeanDifference& difference, double allowance = 0);

}  // namespace metrics
