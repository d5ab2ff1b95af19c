// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/device/tile_watch.h"

#include "target_core/device/bindings.h"

namespace target_core {

using render_system::PathKernel;
using render_system::PathStates;

namespace {

template <class Word, class Row>
std::span<const Word> words(const TileRows<Row>& rows, uint count) {
    constexpr size_t WORDS = sizeof(Row) / sizeof(Word);
    return {reinterpret_cast<const Word*>(rows.get()), count * WORDS};
}

}  // namespace

void show_tile(render_system::PathWatch& watch, const Tile& tile, PathKernel kernel) {
    const uint count = pass.path_count;
    const PathQueue& queue = kernel == PathKernel::extend ? tile.current : tile.next;
    PathStates states;
    states.kernel = kernel;
    states.segment = pass.segment;
    states.sample = pass.sample_index;
    states.first_pixel = pass.first_pixel;
    states.path_count = count;
    states.origins = words<float>(tile.origin, count);
    states.directions = words<float>(tile.direction, count);
    states.throughputs = words<float>(tile.throughput, count);
    states.radiances = words<float>(tile.radiance, count);
    states.queue = words<uint>(queue.paths, queue.count);
    if (kernel == PathKernel::extend || kernel == PathKernel::shade) {
        states.surfaces = words<uint>(tile.surfaces, tile.surface_count);
    }
    if (kernel == PathKernel::shade || kernel == PathKernel::connect) {
        states.shadow_origins = words<float>(tile.shadow_origin, tile.shadow_count);
        states.shadow_directions = words<float>(tile.shadow_direction, tile.shadow_count);
        states.shadow_contributions = words<float>(tile.shadow_contribution, tile.shadow_count);
    }
    if (kernel == PathKernel::finalize) {
        states.means = words<float>(tile.target, count);
    }
    watch.after(states);
}

}  // namespace target_core
