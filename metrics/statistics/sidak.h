// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace metrics {

/// Sidak's correction ("Rectangular Confidence Regions for the Means of Multivariate Normal Distributions", Journal of
/// the American Statistical Association 62, 1967). Of `tests` tests, each false with probability
/// 1 - (1 - alpha)^(1 / tests), at least one is false with probability alpha, if they are independent; with less where
/// they are not.
double sidak_level(double alpha, size_t tests);

/// The other way round: the p-value of the smallest of `tests` p-values, 1 - (1 - p)^tests.
double sidak_p_value(double smallest, size_t tests);

}  // namespace metrics
