// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: rewritten; the port is target_core/kernels/buffers.h. The contract of both: settings and pass; one fetch
// function per table of layout.h; has_feature; load and store of path state, store only where the mask is set; queues
// by push and load; the number of jobs of this dispatch; the accumulator and the target by pixel.
#ifndef BUFFERS_GLSL
#define BUFFERS_GLSL

#include "bindings.h"
#include "language.glsl"

// The host defines before this text: WORK_GROUP_SIZE, FEATURES, and for each table TABLE_<name> as one of VIA_TEXELS,
// VIA_STORAGE and VIA_ADDRESS, depending on the table's size.
layout(local_size_x = WORK_GROUP_SIZE) in;

layout(set = 0, binding = BINDING_SETTINGS, std140) uniform SettingsBlock { Settings settings; };
layout(set = 0, binding = BINDING_ADDRESSES, std140) uniform AddressesBlock { uvec4 table_addresses[TABLE_COUNT]; };
layout(push_constant) uniform PassBlock { Pass pass; };

// The core brings a macro of that name, so that the condition is a constant where it stands: what a scene does not have
// is gone before any function is inlined.
#ifndef has_feature
bool has_feature(uint feature) { return (FEATURES & feature) != 0u; }
#endif

// ---- Scene tables ----

// clang-format off
#define VIA_TEXELS(Row, Texels, get, name, slot)                 \
    layout(set = 0, binding = slot) uniform Texels name##_table; \
    Row fetch_##name(Uint row) { return texelFetch(name##_table, Int(row)) get; } \
    Row fetch_##name(Rows first, uint offset) { return fetch_##name(first + offset); }

#define VIA_STORAGE(Row, Texels, get, name, slot)                                                          \
    layout(set = 0, binding = slot, std430) restrict readonly buffer name##_block { Row name##_table[]; }; \
    Row fetch_##name(Uint row) { return name##_table[row]; } \
    Row fetch_##name(Rows first, uint offset) { return fetch_##name(first + offset); }

#define VIA_ADDRESS(Row, Texels, get, name, slot)                                                         \
    layout(buffer_reference, std430, buffer_reference_align = 16) restrict readonly buffer name##_block { \
        Row name##_table[];                                                                               \
    };                                                                                                    \
    Row fetch_##name(Uint row) { return name##_block(table_addresses[slot].xy).name##_table[row]; } \
    Row fetch_##name(Rows first, uint offset) { return fetch_##name(first + offset); }

#define WORDS
#define FIRST_WORD .x

TABLE_nodes(vec4, textureBuffer, WORDS, nodes, BINDING_NODES)
TABLE_triangles(vec4, textureBuffer, WORDS, triangles, BINDING_TRIANGLES)
TABLE_mesh_triangles(uvec4, utextureBuffer, WORDS, mesh_triangles, BINDING_MESH_TRIANGLES)
TABLE_vertices(vec4, textureBuffer, WORDS, vertices, BINDING_VERTICES)
TABLE_instances(vec4, textureBuffer, WORDS, instances, BINDING_INSTANCES)
TABLE_materials(vec4, textureBuffer, WORDS, materials, BINDING_MATERIALS)
TABLE_texture_slots(vec4, textureBuffer, WORDS, texture_slots, BINDING_TEXTURE_SLOTS)
TABLE_textures(uvec4, utextureBuffer, WORDS, textures, BINDING_TEXTURES)
TABLE_texels(uint, utextureBuffer, FIRST_WORD, texels, BINDING_TEXELS)
TABLE_lights(vec4, textureBuffer, WORDS, lights, BINDING_LIGHTS)
TABLE_light_table(vec4, textureBuffer, WORDS, light_table, BINDING_LIGHT_TABLE)
TABLE_sky_texels(vec4, textureBuffer, WORDS, sky_texels, BINDING_SKY_TEXELS)
TABLE_sky_table(vec4, textureBuffer, WORDS, sky_table, BINDING_SKY_TABLE)
TABLE_lobe_energy(vec4, textureBuffer, WORDS, lobe_energy, BINDING_LOBE_ENERGY)
TABLE_coincident(uvec4, utextureBuffer, WORDS, coincident, BINDING_COINCIDENT)

Uint fetch_coincident_word(Uint word) { return fetch_coincident(word >> 2)[word & 3u]; }

// ---- Path state and queues. All buffers are declared alike; the host marks those that a kernel does not write (or
// does not read) in the compiled module. ----

#define ROWS(Row, name, slot)                                                                    \
    layout(set = 0, binding = slot, std430) restrict buffer name##_block { Row name##_rows[]; }; \
    Row load_##name(Uint index) { return name##_rows[index]; }                                   \
    void store_##name(Uint index, Row row, Mask where) {                                         \
        if (where) {                                                                             \
            name##_rows[index] = row;                                                            \
        }                                                                                        \
    }

ROWS(vec4, path_origin, BINDING_PATH_ORIGIN)
ROWS(vec4, path_direction, BINDING_PATH_DIRECTION)
ROWS(vec4, path_throughput, BINDING_PATH_THROUGHPUT)
ROWS(vec4, path_radiance, BINDING_PATH_RADIANCE)
ROWS(uvec4, surface_queue, BINDING_SURFACE_QUEUE)
ROWS(uint, queue, BINDING_QUEUE)
ROWS(uint, next_queue, BINDING_NEXT_QUEUE)
ROWS(vec4, shadow_origin, BINDING_SHADOW_ORIGIN)
ROWS(vec4, shadow_direction, BINDING_SHADOW_DIRECTION)
ROWS(vec4, shadow_contribution, BINDING_SHADOW_CONTRIBUTION)
ROWS(vec4, accumulator_row, BINDING_ACCUMULATOR)
ROWS(vec4, target_row, BINDING_TARGET)
ROWS(vec4, guide_row, BINDING_GUIDES)
ROWS(vec4, filter_picture, BINDING_FILTER_PICTURE)
ROWS(float, plane_word, BINDING_PLANES)
ROWS(float, history_word, BINDING_HISTORY)
ROWS(float, history_before_word, BINDING_HISTORY_BEFORE)

layout(set = 0, binding = BINDING_COUNTERS, std430) restrict buffer CountersBlock { uint counters[]; };
layout(set = 0, binding = BINDING_ARGUMENTS, std430) restrict buffer ArgumentsBlock { uint arguments[]; };
// clang-format on

uint segment_counter(uint segment, uint kind) { return COUNTER_SEGMENTS + segment * COUNTERS_PER_SEGMENT + kind; }

uint extension_job_count() { return counters[segment_counter(pass.segment, COUNTER_EXTENSION)]; }

uint shadow_job_count() { return counters[segment_counter(pass.segment, COUNTER_SHADOW)]; }

uint surface_job_count() { return counters[segment_counter(pass.segment, COUNTER_SURFACE)]; }

Uint load_extension_job(Uint job) { return load_queue(job); }

uvec4 load_surface_job(Uint job) { return load_surface_queue(job); }

void push_surface_job(uvec4 path_instance_triangle, Mask where) {
    if (where) {
        Uint entry = atomicAdd(counters[segment_counter(pass.segment, COUNTER_SURFACE)], 1u);
        store_surface_queue(entry, path_instance_triangle, true);
    }
}

void store_path_rows(Uint path, vec4 origin, vec4 direction, vec4 throughput, Mask where) {
    store_path_origin(path, origin, where);
    store_path_direction(path, direction, where);
    store_path_throughput(path, throughput, where);
}

// generate runs as segment 0.
void push_extension_ray(Uint path, Mask where) {
    if (where) {
        Uint entry = atomicAdd(counters[segment_counter(pass.segment + 1u, COUNTER_EXTENSION)], 1u);
        store_next_queue(entry, path, true);
    }
}

void push_shadow_ray(vec4 origin_tmax, vec4 direction_path, vec4 contribution, Mask where) {
    if (where) {
        Uint entry = atomicAdd(counters[segment_counter(pass.segment, COUNTER_SHADOW)], 1u);
        store_shadow_origin(entry, origin_tmax, true);
        store_shadow_direction(entry, direction_path, true);
        store_shadow_contribution(entry, contribution, true);
    }
}

// Accumulator and target are bound from the batch's first pixel on.
vec4 load_accumulator(Uint pixel) { return load_accumulator_row(pixel - pass.first_pixel); }

void store_accumulator(Uint pixel, vec4 sum) { store_accumulator_row(pixel - pass.first_pixel, sum, true); }

void store_target(Uint pixel, vec4 mean) { store_target_row(pixel - pass.first_pixel, mean, true); }

uint guide_rows() { return settings.frame == 0u ? GUIDE_ROWS : GUIDE_ROWS + GUIDE_MOTION_ROWS; }

// Pixels by number, and those of jobs, which follow each other, as their neighbours do: the target core reads and
// writes these as a whole.
#define Pixels Uint
Pixels pixels_from(Uint pixel) { return pixel; }
Pixels pixels_in_order(Uint pixel) { return pixel; }
Pixels pixels_beside(Pixels pixels, int far) { return pixels + Uint(far); }
Int pixel_row(Pixels pixels, uint width) { return Int(pixels / width); }
Int pixel_column(Pixels pixels, Int row, uint width) { return Int(pixels) - row * Int(width); }

vec4 load_guide(Uint pixel, Uint row) { return load_guide_row(pixel * guide_rows() + row); }

vec4 load_guides(Pixels pixels, uint row) { return load_guide(pixels, row); }

void add_to_guide(Uint pixel, Uint row, vec4 more, Mask where) {
    Uint place = pixel * guide_rows() + row;
    store_guide_row(place, load_guide_row(place) + more, where);
}

void store_filter_picture(Uint pixel, vec4 row) { store_filter_picture(pixel, row, true); }

// Behind the picture.
vec4 fetch_motions(Rows first, uint offset) { return load_filter_picture(settings.pixel_count + first + offset); }

// A number of a plane by pixel. A neighbour past the ends of a picture is the pixel there; what that says counts for
// nothing.
Float load_plane(uint plane, Pixels pixels) {
    return load_plane_word(plane * settings.pixel_count + Uint(clamp(Int(pixels), 0, int(settings.pixel_count) - 1)));
}
void store_plane(uint plane, Pixels pixels, Float value) {
    store_plane_word(plane * settings.pixel_count + pixels, value, true);
}
Float load_history_before(uint plane, Pixels pixels) {
    return load_history_before_word(plane * settings.pixel_count + pixels);
}
Float load_history(uint plane, Pixels pixels) { return load_history_word(plane * settings.pixel_count + pixels); }
void store_history(uint plane, Pixels pixels, Float value) {
    store_history_word(plane * settings.pixel_count + pixels, value, true);
}

#endif
