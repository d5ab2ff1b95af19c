// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/portability/least_squares.h"

#include <cmath>
#include <utility>

#include "metrics/statistics/student.h"

namespace metrics {
namespace {

using Matrix = std::vector<std::vector<double>>;

/// Inverts a symmetric matrix with ones on its diagonal; none if it is near singular.
std::optional<Matrix> inverted(Matrix a) {
    const size_t n = a.size();
    Matrix inverse(n, std::vector<double>(n, 0));
    for (size_t i = 0; i < n; ++i) inverse[i][i] = 1;
    constexpr double kSingular = 1e-12;
    for (size_t column = 0; column < n; ++column) {
        size_t pivot = column;
        for (size_t row = column + 1; row < n; ++row)
            if (std::abs(a[row][column]) > std::abs(a[pivot][column])) pivot = row;
        if (!(std::abs(a[pivot][column]) > kSingular)) return std::nullopt;
        std::swap(a[pivot], a[column]);
        std::swap(inverse[pivot], inverse[column]);
        const double scale = 1 / a[column][column];
        for (size_t k = 0; k < n; ++k) {
            a[column][k] *= scale;
            inverse[column][k] *= scale;
        }
        for (size_t row = 0; row < n; ++row) {
            const double factor = a[row][column];
            if (row == column || factor == 0) continue;
            for (size_t k = 0; k < n; ++k) {
                a[row][k] -= factor * a[column][k];
                inverse[row][k] -= factor * inverse[column][k];
            }
        }
    }
    return inverse;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size() && i < b.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// (X'X)^-1; columns are brought to length 1 first, so that lines and hours weigh alike.
std::optional<Matrix> inverse_of_products(const Matrix& rows, size_t n) {
    Matrix products(n, std::vector<double>(n, 0));
    for (const auto& row : rows)
        for (size_t i = 0; i < n; ++i)
            for (size_t k = 0; k < n; ++k) products[i][k] += row[i] * row[k];
    std::vector<double> length(n);
    for (size_t i = 0; i < n; ++i) {
        length[i] = std::sqrt(products[i][i]);
        if (!(length[i] > 0)) return std::nullopt;
    }
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < n; ++k) products[i][k] /= length[i] * length[k];
    std::optional<Matrix> inverse = inverted(std::move(products));
    if (inverse)
        for (size_t i = 0; i < n; ++i)
            for (size_t k = 0; k < n; ++k) (*inverse)[i][k] /= length[i] * length[k];
    return inverse;
}

}  // namespace

std::optional<LinearFit> fit_least_squares(const std::vector<std::vector<double>>& rows,
                                           const std::vector<double>& observed) {
    const size_t n = rows.empty() ? 0 : rows.front().size();
    if (n == 0 || rows.size() != observed.size() || rows.size() <= n) return std::nullopt;
    std::optional<Matrix> inverse = inverse_of_products(rows, n);
    if (!inverse) return std::nullopt;
    std::vector<double> right(n, 0);
    for (size_t r = 0; r < rows.size(); ++r)
        for (size_t i = 0; i < n; ++i) right[i] += rows[r][i] * observed[r];
    LinearFit fit;
    for (size_t i = 0; i < n; ++i) fit.coefficients.push_back(product((*inverse)[i], right));
    double squares = 0;
    for (size_t r = 0; r < rows.size(); ++r) {
        const double residual = observed[r] - product(rows[r], fit.coefficients);
        squares += residual * residual;
    }
    fit.degrees_of_freedom = static_cast<int>(rows.size() - n);
    fit.residual_deviation = std::sqrt(squares / fit.degrees_of_freedom);
    fit.inverse = std::move(*inverse);
    return fit;
}

double standard_error(const LinearFit& fit, size_t coefficient) {
    return fit.residual_deviation * std::sqrt(fit.inverse[coefficient][coefficient]);
}

Prediction predict(const LinearFit& fit, const std::vector<double>& predictors) {
    double spread = 1;
    for (size_t i = 0; i < predictors.size(); ++i) spread += predictors[i] * product(fit.inverse[i], predictors);
    const double value = product(fit.coefficients, predictors);
    constexpr double kUpper = 0.975;
    const double reach = student_quantile(kUpper, fit.degrees_of_freedom) * fit.residual_deviation * std::sqrt(spread);
    return {value, value - reach, value + reach};
}

}  // namespace metrics
