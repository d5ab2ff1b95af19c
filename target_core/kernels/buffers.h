// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: rewritten; the original is source_core/kernels/buffers.glsl. The contract of both: settings and pass; one fetch
// function per table of layout.h; has_feature; load and store of path state, store only where the mask is set; queues
// by push and load; the number of jobs of this dispatch; the accumulator and the target by pixel; what a filter has.
#pragma once

#include "target_core/device/bindings.h"
#include "target_core/device/lanes.h"

#ifndef TARGET_CORE_WITHOUT
#define TARGET_CORE_WITHOUT 0u
#endif

namespace target_core::kernels {

// Asked of the scene at run time; what the text is compiled without is gone from it.
inline bool has_feature(uint feature) { return (settings.features & feature & ~TARGET_CORE_WITHOUT) != 0u; }

// ---- Scene tables ----

inline uvec4 fetch_mesh_triangles(Uint row) { return gather(bound.mesh_triangles, row); }
inline vec4 fetch_vertices(Rows first, uint offset) { return gather(bound.vertices, first, offset); }
inline vec4 fetch_instances(Rows first, uint offset) { return gather_shared(bound.instances, first, offset); }
inline vec4 fetch_materials(Rows first, uint offset) { return gather_shared(bound.materials, first, offset); }
inline vec4 fetch_texture_slots(Rows first, uint offset) { return gather_shared(bound.texture_slots, first, offset); }
inline uvec4 fetch_textures(Uint row) { return gather_shared(bound.textures, row); }
inline Uint fetch_texels(Uint texel) { return gather(bound.texels, texel); }
inline vec4 fetch_lights(Rows first, uint offset) { return gather(bound.lights, first, offset); }
inline vec4 fetch_light_table(Uint row) { return gather(bound.light_table, row); }
inline vec4 fetch_sky_texels(Uint row) { return gather(bound.sky_texels, row); }
inline vec4 fetch_sky_table(Uint row) { return gather(bound.sky_table, row); }
inline vec4 fetch_lobe_energy(Uint row) { return gather(bound.lobe_energy, row); }
inline uvec4 fetch_coincident(Uint row) { return gather(bound.coincident, row); }
inline Uint fetch_coincident_word(Uint word) { return gather(&bound.coincident->x, word); }

// ---- Path state ----

inline vec4 load_path_origin(Rows path) { return gather(bound.tile->origin.get(), path, 0u); }
inline vec4 load_path_direction(Rows path) { return gather(bound.tile->direction.get(), path, 0u); }
inline vec4 load_path_throughput(Rows path) { return gather(bound.tile->throughput.get(), path, 0u); }
inline vec4 load_path_radiance(Rows path) { return gather(bound.tile->radiance.get(), path, 0u); }

inline void store_path_rows(Uint path, vec4 origin, vec4 direction, vec4 throughput, Mask where) {
    Places places = places_of(path, where);
    scatter(bound.tile->origin, places, origin);
    scatter(bound.tile->direction, places, direction);
    scatter(bound.tile->throughput, places, throughput);
}
inline void store_path_radiance(Uint path, vec4 row, Mask where) {
    scatter(bound.tile->radiance, places_of(path, where), row);
}

// ---- Queues: no atomics, a tile belongs to one thread ----

inline Uint load_extension_job(Uint job) { return gather(bound.tile->current.paths.get(), job); }
inline uint extension_job_count() { return bound.tile->current.count; }

inline uvec4 load_surface_job(Uint job) { return gather_jobs(bound.tile->surfaces, job); }
inline uint surface_job_count() { return bound.tile->surface_count; }

inline void push_surface_job(uvec4 path_instance_triangle, Mask where) {
    Tile& tile = *bound.tile;
    tile.surface_count = compact(tile.surfaces, tile.surface_count, path_instance_triangle, where);
}

inline void push_extension_ray(Uint path, Mask where) {
    PathQueue& next = bound.tile->next;
    next.count = compact(next.paths, next.count, path, where);
}

inline vec4 load_shadow_origin(Uint job) { return gather_jobs(bound.tile->shadow_origin, job); }
inline vec4 load_shadow_direction(Uint job) { return gather_jobs(bound.tile->shadow_direction, job); }
inline vec4 load_shadow_contribution(Uint job) { return gather_jobs(bound.tile->shadow_contribution, job); }
inline uint shadow_job_count() { return bound.tile->shadow_count; }

inline void push_shadow_ray(vec4 origin, vec4 direction, vec4 contribution, Mask where) {
    Tile& tile = *bound.tile;
    compact(tile.shadow_origin, tile.shadow_count, origin, where);
    compact(tile.shadow_direction, tile.shadow_count, direction, where);
    tile.shadow_count = compact(tile.shadow_contribution, tile.shadow_count, contribution, where);
}

// ---- Pictures ----

inline vec4 load_accumulator(Uint pixel) { return gather(bound.accumulator, pixel); }
inline void store_accumulator(Uint pixel, vec4 sum) { scatter(bound.accumulator, pixel, sum, true); }
inline void store_target(Uint pixel, vec4 mean) {
    scatter(bound.tile->target.get(), pixel - pass.first_pixel, mean, true);
}

// ---- What a filter has ----

inline uint guide_rows() { return settings.frame == 0u ? GUIDE_ROWS : GUIDE_ROWS + GUIDE_MOTION_ROWS; }

inline vec4 load_guide(Uint pixel, Uint row) { return gather_block_rows(bound.guides, pixel, row, guide_rows()); }

inline vec4 load_guides(Pixels pixels, uint row) { return gather_blocks(bound.guides, pixels, row, guide_rows()); }

inline void add_to_guide(Uint pixel, Uint row, vec4 more, Mask where) {
    add_to_block_rows(bound.guides, pixel, row, guide_rows(), more, where);
}

inline vec4 load_filter_picture(Pixels pixels) { return gather_pixels(bound.filter_picture, pixels); }
inline void store_filter_picture(Pixels pixels, vec4 row) { scatter_pixels(bound.filter_picture, pixels, row); }

inline vec4 fetch_motions(Rows first, uint offset) { return gather_shared(bound.motions, first, offset); }

inline Float load_plane(uint plane, Pixels pixels) {
    return gather_plane(bound.planes + size_t{plane} * bound.plane_stride, pixels);
}
inline void store_plane(uint plane, Pixels pixels, Float value) {
    scatter_plane(bound.planes + size_t{plane} * bound.plane_stride, pixels, value);
}
inline Float load_history_before(uint plane, Pixels pixels) {
    return gather_plane(bound.history_before + size_t{plane} * settings.pixel_count, pixels);
}
inline Float load_history(uint plane, Pixels pixels) {
    return gather_plane(bound.history + size_t{plane} * settings.pixel_count, pixels);
}
inline void store_history(uint plane, Pixels pixels, Float value) {
    scatter_plane(bound.history + size_t{plane} * settings.pixel_count, pixels, value);
}

}  // namespace target_core::kernels
