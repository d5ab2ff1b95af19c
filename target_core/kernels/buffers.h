// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: rewritten; the original is source_core/kernels/buffers.glsl. The contract of both: settings and pass; one fetch
// function per table of layout.h; has_feature; load and store of path state, store only where the mask is set; queues
// by push and load; the number of jobs of this dispatch; the accumulator and the target by pixel.
#pragma once

#include "target_core/device/bindings.h"
#include "target_core/device/lanes.h"

namespace target_core::kernels {

inline bool has_feature(uint feature) { return (settings.features & feature) != 0u; }

// ---- Scene tables ----

inline uvec4 fetch_mesh_triangles(Uint row) { return bound.mesh_triangles[row]; }
inline vec4 fetch_vertices(Uint row) { return bound.vertices[row]; }
inline Uint fetch_tangents(Uint row) { return bound.tangents[row]; }
inline vec4 fetch_instances(Uint row) { return bound.instances[row]; }
inline vec4 fetch_materials(Uint row) { return bound.materials[row]; }
inline vec4 fetch_texture_slots(Uint row) { return bound.texture_slots[row]; }
inline uvec4 fetch_textures(Uint row) { return bound.textures[row]; }
inline Uint fetch_texels(Uint texel) { return bound.texels[texel]; }
inline vec4 fetch_lights(Uint row) { return bound.lights[row]; }
inline vec4 fetch_light_table(Uint row) { return bound.light_table[row]; }
inline vec4 fetch_sky_texels(Uint row) { return bound.sky_texels[row]; }
inline vec4 fetch_sky_table(Uint row) { return bound.sky_table[row]; }

// ---- Path state ----

template <class Row>
inline void store_row(Row* rows, Uint index, Row row, Mask where) {
    if (where) {
        rows[index] = row;
    }
}

inline vec4 load_path_origin(Uint path) { return bound.tile->origin[path]; }
inline vec4 load_path_direction(Uint path) { return bound.tile->direction[path]; }
inline vec4 load_path_throughput(Uint path) { return bound.tile->throughput[path]; }
inline vec4 load_path_radiance(Uint path) { return bound.tile->radiance[path]; }
inline uvec4 load_path_hit(Uint path) { return bound.tile->hit[path]; }

inline void store_path_origin(Uint path, vec4 row, Mask where) {
    store_row(bound.tile->origin.get(), path, row, where);
}
inline void store_path_direction(Uint path, vec4 row, Mask where) {
    store_row(bound.tile->direction.get(), path, row, where);
}
inline void store_path_throughput(Uint path, vec4 row, Mask where) {
    store_row(bound.tile->throughput.get(), path, row, where);
}
inline void store_path_radiance(Uint path, vec4 row, Mask where) {
    store_row(bound.tile->radiance.get(), path, row, where);
}
inline void store_path_hit(Uint path, uvec4 row, Mask where) { store_row(bound.tile->hit.get(), path, row, where); }

// ---- Queues: no atomics, a tile belongs to one thread ----

inline Uint load_extension_job(Uint job) { return bound.tile->current.paths[job]; }
inline uint extension_job_count() { return bound.tile->current.count; }

inline void push_extension_ray(Uint path, Mask where) {
    if (where) {
        bound.tile->next.paths[bound.tile->next.count++] = path;
    }
}

inline vec4 load_shadow_origin(Uint job) { return bound.tile->shadow_origin[job]; }
inline vec4 load_shadow_direction(Uint job) { return bound.tile->shadow_direction[job]; }
inline vec4 load_shadow_contribution(Uint job) { return bound.tile->shadow_contribution[job]; }
inline uint shadow_job_count() { return bound.tile->shadow_count; }

inline void push_shadow_ray(vec4 origin, vec4 direction, vec4 contribution, Mask where) {
    if (where) {
        uint job = bound.tile->shadow_count++;
        bound.tile->shadow_origin[job] = origin;
        bound.tile->shadow_direction[job] = direction;
        bound.tile->shadow_contribution[job] = contribution;
    }
}

// ---- Pictures ----

inline vec4 load_accumulator(Uint pixel) { return bound.accumulator[pixel]; }
inline void store_accumulator(Uint pixel, vec4 sum) { bound.accumulator[pixel] = sum; }

inline void store_target(Uint pixel, vec4 mean) {
    float* texel = bound.target + size_t{pixel} * 4;
    texel[0] = mean.x;
    texel[1] = mean.y;
    texel[2] = mean.z;
    texel[3] = mean.w;
}

}  // namespace target_core::kernels
