// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "target_core/device/glsl.h"

namespace target_core {

/// Most paths of a tile: few enough that their state stays in the L2 cache, enough to fill the loops over them.
constexpr uint TILE_PATHS = 2048;

/// Tiles are multiples of this, so that camera rays are packed alike however many threads share the picture: what a
/// packet finds between coincident triangles may depend on the rays beside it.
constexpr uint TILE_GRAIN = 16;

/// Room past the end of each row of the tile, for lanes that have nothing to store or append.
constexpr uint SPARE_ROWS = 16;

/// TILE_PATHS rows, one a path or a job, and the spare ones.
template <class Row>
struct TileRows {
    std::unique_ptr<Row[]> rows = std::make_unique<Row[]>(TILE_PATHS + SPARE_ROWS);
    Row* get() const { return rows.get(); }
    Row& operator[](size_t i) const { return rows[i]; }
};

/// A compacted queue of the tile: what the source core keeps behind atomic counters.
struct PathQueue {
    TileRows<uint> paths;
    uint count = 0;
};

/// The state of all paths of one tile, in structure of arrays. One per thread, reused from tile to tile.
struct Tile {
    TileRows<vec4> origin;
    TileRows<vec4> direction;
    TileRows<vec4> throughput;
    TileRows<vec4> radiance;
    PathQueue current;                 // of this segment
    PathQueue next;                    // of the next one
    TileRows<uvec4> surfaces;          // of this segment: path, instance, triangle
    TileRows<uvec4> ordered_surfaces;  // where order_surfaces puts them, then exchanged with surfaces
    uint surface_count = 0;
    TileRows<vec4> shadow_origin;
    TileRows<vec4> shadow_direction;
    TileRows<vec4> shadow_contribution;
    uint shadow_count = 0;
    TileRows<vec4> target;  // by pixel of the tile
};

}  // namespace target_core
