// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/image/error.h"

#include <bit>
#include <cmath>
#include <cstdlib>

namespace metrics {
namespace {

template <class Value>
double root_mean_square(const ImageView<Value>& a, const ImageView<Value>& b) {
    if (a.rgb.empty()) return 0.0;
    double sum = 0.0;
    for (size_t i = 0; i < a.rgb.size(); ++i) {
        const double difference = static_cast<double>(a.rgb[i]) - static_cast<double>(b.rgb[i]);
        sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(a.rgb.size()));
}

/// Share of the pixels for which `is_so` holds in at least one channel.
template <class Value, class Predicate>
double share_of_pixels(const ImageView<Value>& a, const ImageView<Value>& b, Predicate is_so) {
    if (a.pixels() == 0) return 0.0;
    size_t count = 0;
    for (size_t pixel = 0; pixel < a.pixels(); ++pixel) {
        bool any = false;
        for (size_t channel = 0; channel < CHANNELS; ++channel) {
            const size_t i = pixel * CHANNELS + channel;
            any = any || is_so(a.rgb[i], b.rgb[i]);
        }
        count += any ? 1 : 0;
    }
    return static_cast<double>(count) / static_cast<double>(a.pixels());
}

}  // namespace

double rmse(const ImageView8& a, const ImageView8& b) { return root_mean_square(a, b); }

double rmse_linear(const ImageViewFloat& a, const ImageViewFloat& b) { return root_mean_square(a, b); }

std::optional<double> psnr(const ImageView8& a, const ImageView8& b) {
    const double error = rmse(a, b);
    if (error == 0.0) return std::nullopt;
    return 20.0 * std::log10(255.0 / error);
}

double pixels_off(const ImageView8& a, const ImageView8& b) {
    return share_of_pixels(a, b, [](uint8_t x, uint8_t y) { return std::abs(int{x} - int{y}) > 1; });
}

double identical_pixels(const ImageViewFloat& a, const ImageViewFloat& b) {
    return 1.0 - share_of_pixels(
                     a, b, [](float x, float y) { return std::bit_cast<uint32_t>(x) != std::bit_cast<uint32_t>(y); });
}

}  // namespace metrics
