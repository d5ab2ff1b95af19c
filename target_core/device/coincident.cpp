// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/device/coincident.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "target_core/device/embree_callbacks.h"

namespace target_core {

namespace {

// The finalizer of SplitMix64 (Steele et al. 2014).
uint64_t mixed_bits(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

uint64_t corner_key(const PackedVertex& p) {
    const auto bits = [](float x) { return uint64_t{std::bit_cast<uint>(x + 0.0f)}; };  // -0 is 0
    return mixed_bits(mixed_bits(bits(p.x) << 32 | bits(p.y)) + bits(p.z));
}

// The same for the same three corners in any order.
uint64_t triangle_key(const InstanceGeometry& geometry, uint primitive) {
    const uvec4 corners = geometry.triangles[primitive];
    return corner_key(world_vertex(geometry, corners.x)) + corner_key(world_vertex(geometry, corners.y)) +
           corner_key(world_vertex(geometry, corners.z));
}

// Calls visit(instance, primitive, key) for all triangles, in order.
template <class Visit>
void for_each_key(std::span<const InstanceGeometry> geometry, const Visit& visit) {
    for (uint instance = 0; instance < geometry.size(); ++instance) {
        for (uint primitive = 0; primitive < geometry[instance].triangle_count; ++primitive) {
            visit(instance, primitive, triangle_key(geometry[instance], primitive));
        }
    }
}

}  // namespace

float largest_coordinate(RTCScene scene) {
    RTCBounds box;
    rtcGetSceneBounds(scene, &box);
    const float lower = std::max({std::fabs(box.lower_x), std::fabs(box.lower_y), std::fabs(box.lower_z)});
    return std::max({lower, std::fabs(box.upper_x), std::fabs(box.upper_y), std::fabs(box.upper_z)});
}

std::vector<SharedTriangle> find_shared_triangles(std::span<const InstanceGeometry> geometry) {
    std::vector<uint64_t> keys;
    for_each_key(geometry, [&](uint, uint, uint64_t key) { keys.push_back(key); });
    std::sort(keys.begin(), keys.end());
    std::vector<uint64_t> shared;
    for (size_t i = 1; i < keys.size(); ++i) {
        if (keys[i] == keys[i - 1] && (shared.empty() || shared.back() != keys[i])) shared.push_back(keys[i]);
    }
    std::vector<SharedTriangle> found;
    if (shared.empty()) return found;
    for_each_key(geometry, [&](uint instance, uint primitive, uint64_t key) {
        if (std::binary_search(shared.begin(), shared.end(), key)) found.push_back({instance, primitive});
    });
    return found;
}

}  // namespace target_core
