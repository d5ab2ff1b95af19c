// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: rewritten; the original is source_core/kernels/language.glsl.
//
// The lane types that the kernel text is compiled for. This is the backend of one lane, the bit-exact reference. A
// wider one supplies the same names for 8 or 16 values at a time and is put in place of this one by defining
// TARGET_CORE_LANES as its header and `kernels` as a namespace of its own; the kernel text stays as it is.
#pragma once

#ifdef TARGET_CORE_LANES
#include TARGET_CORE_LANES
#else

#include <bit>
#include <cmath>

#include "target_core/device/glsl.h"
#include "target_core/device/tile.h"

namespace target_core::kernels {

// A capital letter says "one value per lane"; float, uint and bool mean "the same for all lanes".
using Float = float;
using Uint = uint32_t;
using Int = int32_t;
using Mask = bool;

using vec2 = Vec2<Float>;
using vec3 = Vec3<Float>;
using vec4 = Vec4<Float>;
using uvec4 = Vec4<Uint>;

inline Float select(Mask where, Float yes, Float no) { return where ? yes : no; }
inline Uint select(Mask where, Uint yes, Uint no) { return where ? yes : no; }
inline Int select(Mask where, Int yes, Int no) { return where ? yes : no; }
inline vec2 select(Mask where, vec2 yes, vec2 no) { return where ? yes : no; }
inline vec3 select(Mask where, vec3 yes, vec3 no) { return where ? yes : no; }
inline vec4 select(Mask where, vec4 yes, vec4 no) { return where ? yes : no; }

// True if some lane is set: guards work that no lane needs. What stands under it must still be masked.
inline bool any_lane(Mask where) { return where; }

inline Float abs(Float x) { return std::fabs(x); }
inline Float sqrt(Float x) { return std::sqrt(x); }
inline Float floor(Float x) { return std::floor(x); }
inline Float min(Float a, Float b) { return b < a ? b : a; }
inline Float max(Float a, Float b) { return a < b ? b : a; }
inline Uint min(Uint a, Uint b) { return b < a ? b : a; }
inline Int min(Int a, Int b) { return b < a ? b : a; }
inline Int max(Int a, Int b) { return a < b ? b : a; }
inline vec3 min(vec3 a, vec3 b) { return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)}; }
inline Float clamp(Float x, Float low, Float high) { return min(max(x, low), high); }
inline Int clamp(Int x, Int low, Int high) { return min(max(x, low), high); }

inline Uint floatBitsToUint(Float x) { return std::bit_cast<Uint>(x); }
inline Float uintBitsToFloat(Uint x) { return std::bit_cast<Float>(x); }

inline Uint bitfieldReverse(Uint x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    return __builtin_bswap32(x);
}

// Calls kernel(job) for every job below `count`.
template <void (*kernel)(Uint)>
inline void for_each_job(uint count) {
    for (uint job = 0; job < count; ++job) {
        kernel(job);
    }
}

// ---- Memory: a row per lane ----

template <class Row>
inline Row gather(const Row* rows, Uint index) {
    return rows[index];
}

template <class Row>
inline void scatter(Row* rows, Uint index, Row row, Mask where) {
    if (where) {
        rows[index] = row;
    }
}

// Where the rows of an entry of a table begin.
using Rows = Uint;
inline Rows rows_from(Uint first) { return first; }

template <class Row>
inline Row gather(const Row* table, Rows first, uint offset) {
    return table[first + offset];
}

// Where wide lanes are likely to want the same row.
template <class Row>
inline Row gather_shared(const Row* rows, Uint index) {
    return rows[index];
}

template <class Row>
inline Row gather_shared(const Row* table, Rows first, uint offset) {
    return table[first + offset];
}

// Pixels of a plane. It goes on for a while before the first and behind the last one: there are zeros.
using Pixels = Uint;
inline Pixels pixels_from(Uint pixel) { return pixel; }
inline Pixels pixels_in_order(Uint pixel) { return pixel; }
inline Pixels pixels_beside(Pixels pixels, int far) { return pixels + static_cast<Uint>(far); }
inline Int pixel_row(Pixels pixels, uint width) { return static_cast<Int>(pixels / width); }
inline Int pixel_column(Pixels pixels, Int row, uint width) {
    return static_cast<Int>(pixels) - row * static_cast<Int>(width);
}
inline Float gather_plane(const float* plane, Pixels pixels) { return plane[static_cast<Int>(pixels)]; }
inline void scatter_plane(float* plane, Pixels pixels, Float value) { plane[pixels] = value; }
template <class Row>
inline Row gather_pixels(const Row* rows, Pixels pixels) {
    return rows[pixels];
}
template <class Row>
inline void scatter_pixels(Row* rows, Pixels pixels, Row row) {
    rows[pixels] = row;
}

// Rows of pixels in blocks: of TILE_GRAIN pixels that follow each other every component of every row is kept together,
// so that wide lanes read and write a component as a whole.
inline float* block_row(float* blocks, uint pixel, uint row, uint rows) {
    return blocks + (size_t{pixel / TILE_GRAIN} * rows + row) * (4 * TILE_GRAIN) + pixel % TILE_GRAIN;
}
inline vec4 gather_block_rows(float* blocks, Uint pixel, Uint row, uint rows) {
    const float* first = block_row(blocks, pixel, row, rows);
    return {first[0], first[TILE_GRAIN], first[2 * TILE_GRAIN], first[3 * TILE_GRAIN]};
}
inline vec4 gather_blocks(float* blocks, Pixels pixels, uint row, uint rows) {
    return gather_block_rows(blocks, pixels, row, rows);
}
inline void add_to_block_rows(float* blocks, Uint pixel, Uint row, uint rows, vec4 more, Mask where) {
    if (where) {
        float* first = block_row(blocks, pixel, row, rows);
        first[0] += more.x;
        first[TILE_GRAIN] += more.y;
        first[2 * TILE_GRAIN] += more.z;
        first[3 * TILE_GRAIN] += more.w;
    }
}

// Rows of a tile by job.
template <class Row>
inline Row gather_jobs(const TileRows<Row>& rows, Uint job) {
    return rows[job];
}

// Rows of a tile to store to.
struct Places {
    Uint row;
    Mask where;
};
inline Places places_of(Uint row, Mask where) { return {row, where}; }

template <class Row>
inline void scatter(const TileRows<Row>& rows, Places places, Row row) {
    scatter(rows.get(), places.row, row, places.where);
}

// Appends the rows of the lanes that are set; the new length.
template <class Row>
inline uint compact(const TileRows<Row>& rows, uint length, Row row, Mask where) {
    scatter(rows.get(), length, row, where);
    return length + (where ? 1u : 0u);
}

}  // namespace target_core::kernels

#endif
