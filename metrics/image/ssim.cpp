// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/image/ssim.h"

#include <array>
#include <cmath>
#include <vector>

namespace metrics {
namespace {

constexpr size_t RADIUS = 5;
constexpr size_t WINDOW = 2 * RADIUS + 1;
constexpr double SIGMA = 1.5;
constexpr double C1 = (0.01 * 255.0) * (0.01 * 255.0);
constexpr double C2 = (0.03 * 255.0) * (0.03 * 255.0);

/// What the formula needs of a window. The two variances only ever appear as their sum, so one moment serves both.
enum Moment : size_t { MEAN_A, MEAN_B, SQUARES, PRODUCT, MOMENTS };

using Kernel = std::array<double, WINDOW>;

/// One row of each moment, `width` values each.
struct MomentRow {
    std::array<std::vector<double>, MOMENTS> values;

    explicit MomentRow(size_t width) {
        for (auto& row : values) row.resize(width);
    }
};

Kernel gaussian() {
    Kernel kernel{};
    double sum = 0.0;
    for (size_t i = 0; i < WINDOW; ++i) {
        const double x = static_cast<double>(i) - static_cast<double>(RADIUS);
        kernel[i] = std::exp(-0.5 * x * x / (SIGMA * SIGMA));
        sum += kernel[i];
    }
    for (double& weight : kernel) weight /= sum;
    return kernel;
}

/// The moments of single pixels in row `y` of one channel.
void load_row(const ImageView8& a, const ImageView8& b, size_t channel, size_t y, MomentRow& out) {
    for (size_t x = 0; x < a.width; ++x) {
        const size_t i = (y * a.width + x) * CHANNELS + channel;
        const double value_a = a.rgb[i];
        const double value_b = b.rgb[i];
        out.values[MEAN_A][x] = value_a;
        out.values[MEAN_B][x] = value_b;
        out.values[SQUARES][x] = value_a * value_a + value_b * value_b;
        out.values[PRODUCT][x] = value_a * value_b;
    }
}

/// Filters along x; `out` is WINDOW - 1 shorter than `in`.
void blur_along_x(const Kernel& kernel, const MomentRow& in, MomentRow& out) {
    for (size_t moment = 0; moment < MOMENTS; ++moment) {
        const double* source = in.values[moment].data();
        std::vector<double>& row = out.values[moment];
        for (size_t x = 0; x < row.size(); ++x) row[x] = kernel[0] * source[x];
        for (size_t tap = 1; tap < WINDOW; ++tap) {
            for (size_t x = 0; x < row.size(); ++x) row[x] += kernel[tap] * source[x + tap];
        }
    }
}

/// Filters along y over a ring of WINDOW rows, the oldest of which stands at `first`.
void blur_along_y(const Kernel& kernel, const std::vector<MomentRow>& ring, size_t first, MomentRow& out) {
    for (size_t moment = 0; moment < MOMENTS; ++moment) {
        std::vector<double>& row = out.values[moment];
        row.assign(row.size(), 0.0);
        for (size_t tap = 0; tap < WINDOW; ++tap) {
            const double* source = ring[(first + tap) % WINDOW].values[moment].data();
            for (size_t x = 0; x < row.size(); ++x) row[x] += kernel[tap] * source[x];
        }
    }
}

/// Sum of the index over one row of windows.
double sum_of_index(const MomentRow& moments) {
    const double* mean_a = moments.values[MEAN_A].data();
    const double* mean_b = moments.values[MEAN_B].data();
    const double* squares = moments.values[SQUARES].data();
    const double* product = moments.values[PRODUCT].data();
    double sum = 0.0;
    for (size_t x = 0; x < moments.values[MEAN_A].size(); ++x) {
        const double means = mean_a[x] * mean_b[x];
        const double mean_squares = mean_a[x] * mean_a[x] + mean_b[x] * mean_b[x];
        const double covariance = product[x] - means;
        const double variances = squares[x] - mean_squares;
        sum += ((2.0 * means + C1) * (2.0 * covariance + C2)) / ((mean_squares + C1) * (variances + C2));
    }
    return sum;
}

double ssim_of_channel(const ImageView8& a, const ImageView8& b, size_t channel, const Kernel& kernel) {
    const size_t columns = a.width - WINDOW + 1;
    const size_t rows = a.height - WINDOW + 1;
    MomentRow pixels(a.width);
    MomentRow blurred(columns);
    std::vector<MomentRow> ring(WINDOW, MomentRow(columns));
    double sum = 0.0;
    for (size_t y = 0; y < a.height; ++y) {
        load_row(a, b, channel, y, pixels);
        blur_along_x(kernel, pixels, ring[y % WINDOW]);
        if (y + 1 < WINDOW) continue;
        blur_along_y(kernel, ring, (y + 1) % WINDOW, blurred);
        sum += sum_of_index(blurred);
    }
    return sum / (static_cast<double>(columns) * static_cast<double>(rows));
}

}  // namespace

std::optional<double> ssim(const ImageView8& a, const ImageView8& b) {
    if (a.width < WINDOW || a.height < WINDOW) return std::nullopt;
    const Kernel kernel = gaussian();
    double sum = 0.0;
    for (size_t channel = 0; channel < CHANNELS; ++channel) sum += ssim_of_channel(a, b, channel, kernel);
    return sum / static_cast<double>(CHANNELS);
}

}  // namespace metrics
