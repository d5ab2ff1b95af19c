// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/animation/curve.h"

#include <algorithm>
#include <cmath>

namespace render_system {

namespace {

// Two neighbouring keys and where between them: 0 at the first, below 1.
struct Between {
    size_t first = 0;
    size_t second = 0;
    double share = 0.0;
    double seconds = 0.0;  // from key to key
};

Between find_keys(const std::vector<float>& times, double time) {
    const auto later = std::upper_bound(times.begin(), times.end(), time,
                                        [](double wanted, float key) { return wanted < static_cast<double>(key); });
    if (later == times.begin()) return {};
    const auto second = static_cast<size_t>(later - times.begin());
    if (later == times.end()) return {second - 1, second - 1, 0.0, 0.0};
    const double start = static_cast<double>(times[second - 1]), end = static_cast<double>(*later);
    return {second - 1, second, (time - start) / (end - start), end - start};
}

double length_of(const std::vector<double>& value) {
    double sum = 0.0;
    for (const double x : value) sum += x * x;
    return std::sqrt(sum);
}

// Appendix C.4. Keys are taken as they are: what comes out is scaled to unit length by who turns with it.
void slerp(const float* a, const float* b, double share, std::vector<double>& value) {
    constexpr double kNearly = 1e-6;  // an angle so small that its sine is no divisor
    double cosine = 0.0;
    for (size_t i = 0; i < value.size(); ++i) cosine += static_cast<double>(a[i]) * static_cast<double>(b[i]);
    const double sign = cosine < 0.0 ? -1.0 : 1.0;
    const double angle = std::acos(std::min(std::abs(cosine), 1.0));
    const bool straight = angle < kNearly;
    const double of_a = straight ? 1.0 - share : std::sin(angle * (1.0 - share)) / std::sin(angle);
    const double of_b = straight ? share : std::sin(angle * share) / std::sin(angle);
    for (size_t i = 0; i < value.size(); ++i)
        value[i] = of_a * static_cast<double>(a[i]) + sign * of_b * static_cast<double>(b[i]);
}

// Appendix C.5, a cubic Hermite spline.
void spline(const float* first, const float* second, const Between& keys, std::vector<double>& value) {
    const size_t width = value.size();
    const double t = keys.share, t2 = t * t, t3 = t2 * t;
    for (size_t i = 0; i < width; ++i) {
        const double start = static_cast<double>(first[width + i]), out = static_cast<double>(first[2 * width + i]);
        const double end = static_cast<double>(second[width + i]), in = static_cast<double>(second[i]);
        value[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * start + keys.seconds * (t3 - 2.0 * t2 + t) * out +
                   (-2.0 * t3 + 3.0 * t2) * end + keys.seconds * (t3 - t2) * in;
    }
}

}  // namespace

void sample_curve(const Curve& curve, double time, std::vector<double>& value) {
    const Between keys = find_keys(*curve.times, time);
    const bool cubic = curve.interpolation == Interpolation::cubic_spline;
    const size_t stride = size_t{curve.width} * (cubic ? 3 : 1);
    const float* first = curve.values->data() + keys.first * stride;
    const float* second = curve.values->data() + keys.second * stride;
    value.resize(curve.width);
    if (curve.interpolation == Interpolation::step || keys.share == 0.0) {
        for (size_t i = 0; i < value.size(); ++i) value[i] = static_cast<double>(first[(cubic ? curve.width : 0) + i]);
    } else if (cubic) {
        spline(first, second, keys, value);
    } else if (curve.is_rotation) {
        slerp(first, second, keys.share, value);
    } else {
        for (size_t i = 0; i < value.size(); ++i) {
            const double start = static_cast<double>(first[i]);
            value[i] = start + keys.share * (static_cast<double>(second[i]) - start);
        }
    }
    const double length = curve.is_rotation && keys.share != 0.0 ? length_of(value) : 0.0;
    for (size_t i = 0; i < value.size() && length > 0.0; ++i) value[i] /= length;
}

}  // namespace render_system
