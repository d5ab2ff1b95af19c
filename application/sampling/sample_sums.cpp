// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/sampling/sample_sums.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace application {

std::string range_text(const std::vector<SampleRange>& ranges) {
    std::string text;
    for (const SampleRange& range : ranges)
        text += fmt::format("{}{}:{}", text.empty() ? "" : ",", range.first, range.end);
    return text;
}

std::vector<SampleRange> ranges_of_text(const std::string& text) {
    std::vector<SampleRange> ranges;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        SampleRange range;
        const auto first = std::from_chars(at, end, range.first);
        if (first.ec != std::errc{} || first.ptr == end || *first.ptr != ':') return {};
        const auto last = std::from_chars(first.ptr + 1, end, range.end);
        const bool in_order = ranges.empty() || ranges.back().end < range.first;
        if (last.ec != std::errc{} || range.end <= range.first || !in_order) return {};
        ranges.push_back(range);
        if (last.ptr == end) return ranges;
        if (*last.ptr != ',') return {};
        at = last.ptr + 1;
    }
}

void SampleSums::clear() {
    samples = 0;
    std::fill(pixels.begin(), pixels.end(), render_system::PixelSum{});
    std::fill(squares.begin(), squares.end(), 0.0);
}

Picture mean_picture(const SampleSums& sums) {
    Picture picture(sums.width, sums.height);
    for (size_t i = 0; i < sums.pixels.size(); ++i)
        picture.pixels[i] = glm::vec4(mean_of(sums.pixels[i], sums.samples), 1.0f);
    return picture;
}

std::vector<float> variances_of(const SampleSums& sums) {
    std::vector<float> variances;
    if (sums.samples < 2) return variances;
    const double count = sums.samples;
    for (size_t i = 0; i < sums.squares.size(); ++i) {
        const glm::vec3 color = mean_of(sums.pixels[i], sums.samples);
        const double mean = 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
        const double variance = std::max(0.0, sums.squares[i] / count - mean * mean);
        variances.push_back(static_cast<float>(variance / (count - 1.0)));
    }
    return variances;
}

double noise_of(const SampleSums& sums) {
    if (sums.samples < 2 || sums.squares.empty()) return std::numeric_limits<double>::infinity();
    const double count = sums.samples;
    double total = 0.0;
    for (size_t i = 0; i < sums.pixels.size(); ++i) {
        const glm::vec3 color = mean_of(sums.pixels[i], sums.samples);
        const double mean = 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
        const double variance = std::max(0.0, (sums.squares[i] / count - mean * mean) * count / (count - 1.0));
        total += std::sqrt(variance / count) / (mean + 0.01);
    }
    return total / static_cast<double>(sums.pixels.size());
}

}  // namespace application
