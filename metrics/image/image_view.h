// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace metrics {

/// An image of three interleaved channels, row-major from the top left. `rgb` holds width * height * 3 values and
/// belongs to the caller. Two images that are compared have the same size; the formulas take that for granted.
template <class Value>
struct ImageView {
    size_t width = 0;
    size_t height = 0;
    std::span<const Value> rgb;

    size_t pixels() const { return width * height; }
};

using ImageView8 = ImageView<uint8_t>;    ///< what a PNG holds, 0 to 255
using ImageViewFloat = ImageView<float>;  ///< linear radiance

constexpr size_t CHANNELS = 3;

}  // namespace metrics
