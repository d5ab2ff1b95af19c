// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace metrics {

/// A linear model y = b0 x0 + b1 x1 + ... fitted to observations.
struct LinearFit {
    std::vector<double> coefficients;
    double residual_deviation = 0;  ///< root of (residual sum of squares / degrees of freedom)
    int degrees_of_freedom = 0;
    std::vector<std::vector<double>> inverse;  ///< of X'X
};

/// Ordinary least squares by Gauss-Jordan elimination of the normal equations on scaled columns. `rows` holds the
/// predictors of each observation, with a 1 for an intercept. None where observations are fewer than predictors + 1, or
/// where a predictor is a combination of the others (as where all observations are alike).
std::optional<LinearFit> fit_least_squares(const std::vector<std::vector<double>>& rows,
                                           const std::vector<double>& observed);

/// Of a coefficient: s sqrt((X'X)^-1 at its place on the diagonal).
double standard_error(const LinearFit& fit, size_t coefficient);

/// A prediction with the interval in which a new observation lies with 95 % probability: y0 +- t s sqrt(1 + x0'(X'X)^-1
/// x0).
struct Prediction {
    double value, low, high;
};
Prediction predict(const LinearFit& fit, const std::vector<double>& predictors);

}  // namespace metrics
