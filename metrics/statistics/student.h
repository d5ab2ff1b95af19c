// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace metrics {

/// The regularised incomplete beta function I_x(a, b) for a, b > 0 and x in [0, 1], by its continued fraction (DLMF
/// 8.17.22) with Lentz's method; small values keep their relative precision.
double incomplete_beta(double a, double b, double x);

/// Probability that Student's t with so many degrees of freedom (any number above 0) is at least |t| away from 0: the
/// p-value of a two-sided test. 0 for an infinite t, 1 for t = 0.
double student_two_sided(double t, double degrees_of_freedom);

/// The t that is exceeded with that probability on both sides together: the inverse of student_two_sided.
double student_critical(double p_value, double degrees_of_freedom);

/// The value below which Student's t lies with that probability (0 < p < 1).
double student_quantile(double probability, double degrees_of_freedom);

}  // namespace metrics
