// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "application/picture.h"
#include "render_system/pixel_sum.h"

namespace application {

/// Samples [first, end) of every pixel.
struct SampleRange {
    uint32_t first = 0;
    uint32_t end = 0;

    uint32_t count() const { return end - first; }
    bool operator==(const SampleRange&) const = default;
};

/// Ranges as text: "0:8,12:16".
std::string range_text(const std::vector<SampleRange>& ranges);

/// The ranges of such a text, or none where it is not one, or they are not in order and apart.
std::vector<SampleRange> ranges_of_text(const std::string& text);

/// The samples of a picture so far.
struct SampleSums {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t samples = 0;                         ///< of every pixel
    std::vector<render_system::PixelSum> pixels;  ///< row-major from the top left
    std::vector<double> squares;                  ///< of luminance, where noise is watched; else none

    SampleSums(uint32_t width_in, uint32_t height_in, bool watches_noise)
        : width(width_in),
          height(height_in),
          pixels(size_t{width} * height),
          squares(watches_noise ? pixels.size() : 0) {}

    /// No samples again.
    void clear();
};

/// The picture of the samples so far, at least 1.
Picture mean_picture(const SampleSums& sums);

/// The variance of each pixel's mean luminance, judged from its own samples, which count as independent. Empty without
/// squares or with fewer than two samples.
std::vector<float> variances_of(const SampleSums& sums);

/// How noisy the picture is: the mean over pixels of standard error / (mean + 0.01), both of linear luminance. The
/// samples count as independent, as they are not quite: what the sequences gain over chance is left out, so the true
/// error is rather less. Needs squares and two samples; infinite with less.
double noise_of(const SampleSums& sums);

}  // namespace application
