// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace render_system {

/// The sum of a pixel's samples, exact: in which order samples and parts of the sum are added changes no bit. So a
/// picture can be taken in parts, on many machines, and be the picture of one run.
///
/// A sample is cut into a multiple of 2^-10, summed in a double, and a rest, rounded to a multiple of 2^-50 and summed
/// as an integer (binned summation: Demmel and Nguyen, "Parallel Reproducible Summation", 2015). Both are exact up to
/// sums of 2^43 and 2^24 samples. Of a sample at most 2^-51, about 4e-16, is lost; above 2^43 the order may be seen.
/// A sample that is not finite makes the sum so.
struct PixelSum {
    double high[3] = {0.0, 0.0, 0.0};
    int64_t low[3] = {0, 0, 0};  ///< in units of 2^-50

    bool operator==(const PixelSum&) const = default;
};

constexpr double kPixelSumLowUnit = 0x1p-50;

inline void add_sample(PixelSum& sum, const glm::vec3& radiance) {
    constexpr double kCut = 0x1.8p42;  // its last bit is worth 2^-10
    for (int channel = 0; channel < 3; ++channel) {
        const double value = radiance[channel];
        const double high = (value + kCut) - kCut;
        const double rest = std::isfinite(value) ? value - high : 0.0;
        sum.high[channel] += std::isfinite(value) ? high : value;
        sum.low[channel] += std::llrint(rest * 0x1p50);
    }
}

inline void add_sum(PixelSum& sum, const PixelSum& other) {
    for (int channel = 0; channel < 3; ++channel) {
        sum.high[channel] += other.high[channel];
        sum.low[channel] += other.low[channel];
    }
}

/// What was added to `before` to make it `sum`.
inline PixelSum difference(const PixelSum& sum, const PixelSum& before) {
    PixelSum added;
    for (int channel = 0; channel < 3; ++channel) {
        added.high[channel] = sum.high[channel] - before.high[channel];
        added.low[channel] = sum.low[channel] - before.low[channel];
    }
    return added;
}

/// The mean of `samples` samples, at least 1.
inline glm::vec3 mean_of(const PixelSum& sum, uint32_t samples) {
    glm::vec3 mean;
    for (int channel = 0; channel < 3; ++channel)
        mean[channel] = static_cast<float>(
            (sum.high[channel] + static_cast<double>(sum.low[channel]) * kPixelSumLowUnit) / samples);
    return mean;
}

/// The sums of squared luminance of `count` pixels from `first` on, where there are any.
inline std::span<double> part_of_squares(std::span<double> squares, size_t first, size_t count) {
    return squares.empty() ? squares : squares.subspan(first, count);
}

/// Adds one sample of each pixel to the sums and, where there are any, to the sums of squared luminance. `Row` is any
/// vector with x, y and z.
template <class Row>
void add_samples(std::span<PixelSum> sums, std::span<double> squares, const Row* radiance) {
    for (size_t i = 0; i < sums.size(); ++i) add_sample(sums[i], {radiance[i].x, radiance[i].y, radiance[i].z});
    for (size_t i = 0; i < squares.size(); ++i) {
        const Row& value = radiance[i];
        const double luminance = 0.2126 * value.x + 0.7152 * value.y + 0.0722 * value.z;
        squares[i] += luminance * luminance;
    }
}

}  // namespace render_system
