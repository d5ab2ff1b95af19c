// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/device/surface_order.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "target_core/device/bindings.h"

namespace target_core {

namespace {

constexpr uint BINS = 256;

uint bin_of(const uvec4& surface) { return bound.geometry[surface.y].bin; }

}  // namespace

void assign_bins(std::span<InstanceGeometry> geometry) {
    std::vector<size_t> order(geometry.size());
    std::iota(order.begin(), order.end(), size_t{0});
    auto material_of = [&](size_t i) { return geometry[i].triangle_count > 0 ? geometry[i].triangles[0].w : 0u; };
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return material_of(a) < material_of(b); });
    for (size_t i = 0; i < order.size(); ++i) {
        geometry[order[i]].bin = static_cast<uint>(i * BINS / order.size());
    }
}

// Counting sort.
void order_surfaces(Tile& tile) {
    uint first[BINS + 1] = {};
    for (uint i = 0; i < tile.surface_count; ++i) {
        ++first[bin_of(tile.surfaces[i]) + 1];
        __builtin_prefetch(&bound.geometry[tile.surfaces[i].y].triangles[tile.surfaces[i].z]);
    }
    for (uint bin = 0; bin < BINS; ++bin) {
        first[bin + 1] += first[bin];
    }
    for (uint i = 0; i < tile.surface_count; ++i) {
        const uvec4& surface = tile.surfaces[i];
        tile.ordered_surfaces[first[bin_of(surface)]++] = surface;
        const InstanceGeometry& geometry = bound.geometry[surface.y];
        const uvec4& corners = geometry.triangles[surface.z];
        __builtin_prefetch(geometry.positions + corners.x);
        __builtin_prefetch(geometry.positions + corners.y);
        __builtin_prefetch(geometry.positions + corners.z);
    }
    std::swap(tile.surfaces, tile.ordered_surfaces);
}

}  // namespace target_core
