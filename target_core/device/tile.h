// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "target_core/device/glsl.h"

namespace target_core {

/// Paths per tile: small enough that a tile's state stays in the L2 cache, large enough to fill its loops.
constexpr uint TILE_PATHS = 1024;

/// A compacted queue of the tile: what the source core keeps behind atomic counters.
struct PathQueue {
    std::unique_ptr<uint[]> paths = std::make_unique<uint[]>(TILE_PATHS);
    uint count = 0;
};

/// The state of all paths of one tile, in structure of arrays. One per thread, reused from tile to tile.
struct Tile {
    std::unique_ptr<vec4[]> origin = std::make_unique<vec4[]>(TILE_PATHS);
    std::unique_ptr<vec4[]> direction = std::make_unique<vec4[]>(TILE_PATHS);
    std::unique_ptr<vec4[]> throughput = std::make_unique<vec4[]>(TILE_PATHS);
    std::unique_ptr<vec4[]> radiance = std::make_unique<vec4[]>(TILE_PATHS);
    std::unique_ptr<uvec4[]> hit = std::make_unique<uvec4[]>(TILE_PATHS);
    PathQueue current;  // of this segment
    PathQueue next;     // of the next one
    std::unique_ptr<vec4[]> shadow_origin = std::make_unique<vec4[]>(TILE_PATHS);
    std::unique_ptr<vec4[]> shadow_direction = std::make_unique<vec4[]>(TILE_PATHS);
    std::unique_ptr<vec4[]> shadow_contribution = std::make_unique<vec4[]>(TILE_PATHS);
    uint shadow_count = 0;
};

}  // namespace target_core
