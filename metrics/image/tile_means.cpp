// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/image/tile_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace metrics {
namespace {

/// Sums over the pixels of a tile.
struct TileSum {
    std::array<double, CHANNELS> rgb{};
    double pixels = 0;

    void add(const TileSum& other) {
        for (size_t channel = 0; channel < CHANNELS; ++channel) rgb[channel] += other.rgb[channel];
        pixels += other.pixels;
    }
};

}  // namespace

TileGrid sixteen_along(size_t width, size_t height) {
    constexpr size_t kAlong = 16, kLeastSide = 8;
    return {width, height, std::max(kLeastSide, (std::max(width, height) + kAlong - 1) / kAlong)};
}

TileMeans::TileMeans(const TileGrid& grid, std::vector<bool> left_out)
    : grid_(grid), masked_(std::move(left_out)), values_((grid.tiles() + 1) * CHANNELS) {}

void TileMeans::add(const ImageViewFloat& picture) {
    std::vector<TileSum> sums(grid_.tiles() + 1);
    for (size_t pixel = 0; pixel < picture.pixels(); ++pixel) {
        if (!masked_.empty() && masked_[pixel]) continue;
        const float* rgb = &picture.rgb[pixel * CHANNELS];
        if (!std::isfinite(rgb[0]) || !std::isfinite(rgb[1]) || !std::isfinite(rgb[2])) {
            ++left_out_;
            continue;
        }
        sums[grid_.tile_of(pixel % grid_.width, pixel / grid_.width)].add({{rgb[0], rgb[1], rgb[2]}, 1});
    }
    for (size_t tile = 0; tile < grid_.tiles(); ++tile) sums.back().add(sums[tile]);
    for (size_t tile = 0; tile < sums.size(); ++tile) {
        for (size_t channel = 0; channel < CHANNELS; ++channel) {
            const TileSum& sum = sums[tile];
            values_[tile * CHANNELS + channel].push_back(sum.pixels > 0 ? sum.rgb[channel] / sum.pixels : 0.0);
        }
    }
}

}  // namespace metrics
