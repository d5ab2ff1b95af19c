// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "metrics/image/image_view.h"

namespace metrics {

/// A picture cut into square tiles, row-major from the top left; those at the right and lower border may be smaller.
struct TileGrid {
    size_t width = 0;
    size_t height = 0;
    size_t side = 1;  ///< pixels

    size_t columns() const { return (width + side - 1) / side; }
    size_t rows() const { return (height + side - 1) / side; }
    size_t tiles() const { return columns() * rows(); }
    size_t tile_of(size_t x, size_t y) const { return y / side * columns() + x / side; }
};

/// The grid whose tiles are a sixteenth of the longer side, and no smaller than 8 pixels.
TileGrid sixteen_along(size_t width, size_t height);

/// What is left of a set of pictures for a test of their means: the mean radiance of each tile, and of the whole, in
/// each channel of each picture. Pixels with a channel that is no finite number are left out and counted.
class TileMeans {
public:
    /// `left_out`: pixels that are left out of all pictures, uncounted, so that those of two sets are means of the same
    /// pixels; none: of no picture.
    explicit TileMeans(const TileGrid& grid, std::vector<bool> left_out = {});

    /// One more picture, of the grid's size.
    void add(const ImageViewFloat& picture);

    const TileGrid& grid() const { return grid_; }
    size_t pictures() const { return values_.front().size(); }
    size_t pixels_left_out() const { return left_out_; }

    /// The means of one tile, picture by picture; those of the whole picture for tile == grid().tiles().
    std::span<const double> values(size_t tile, size_t channel) const { return values_[tile * CHANNELS + channel]; }

private:
    TileGrid grid_;
    std::vector<bool> masked_;
    std::vector<std::vector<double>> values_;  ///< [tile * CHANNELS + channel][picture], the whole picture last
    size_t left_out_ = 0;
};

}  // namespace metrics
