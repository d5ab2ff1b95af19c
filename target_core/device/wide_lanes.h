// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The lane types of a wide backend, the counterpart of the one-lane part of lanes.h: LANES values at a time on GCC
// vector extensions. Included by the header of an instruction set (lanes_avx2.h, lanes_avx512.h), which supplies the
// types *Lanes and what the extensions lack. Every operation gives the bits of the one-lane backend.
#pragma once

#include <bit>
#include <cstddef>

#include "target_core/device/tile.h"

namespace target_core::kernels {

// Tiles begin and end with full packets of camera rays on any number of threads.
static_assert(TILE_PATHS % LANES == 0 && SPARE_ROWS >= LANES && TILE_GRAIN % LANES == 0);

struct Mask {
    MaskLanes v;
    Mask() = default;
    Mask(bool set) : v(mask_of(set)) {}
    static Mask of(MaskLanes lanes) {
        Mask mask;
        mask.v = lanes;
        return mask;
    }
    friend Mask operator!(Mask a) { return of(inverted(a.v)); }
    friend Mask operator&&(Mask a, Mask b) { return of(both(a.v, b.v)); }
    friend Mask operator||(Mask a, Mask b) { return of(either(a.v, b.v)); }
    friend Mask operator==(Mask a, Mask b) { return of(inverted(differ(a.v, b.v))); }
    friend Mask operator!=(Mask a, Mask b) { return of(differ(a.v, b.v)); }
};

// The operators that Float, Uint and Int share.
#define LANE_OPERATORS(Type)                                                          \
    friend Type operator+(Type a, Type b) { return Type(a.v + b.v); }                 \
    friend Type operator-(Type a, Type b) { return Type(a.v - b.v); }                 \
    friend Type operator*(Type a, Type b) { return Type(a.v * b.v); }                 \
    friend Mask operator<(Type a, Type b) { return Mask::of(less(a.v, b.v)); }        \
    friend Mask operator>(Type a, Type b) { return Mask::of(less(b.v, a.v)); }        \
    friend Mask operator<=(Type a, Type b) { return Mask::of(less_equal(a.v, b.v)); } \
    friend Mask operator>=(Type a, Type b) { return Mask::of(less_equal(b.v, a.v)); } \
    friend Mask operator==(Type a, Type b) { return Mask::of(equal(a.v, b.v)); }      \
    friend Mask operator!=(Type a, Type b) { return !(a == b); }                      \
    friend Type select(Mask where, Type yes, Type no) { return Type(blend_lanes(where.v, yes.v, no.v)); }

struct Uint;
struct Int;

struct Float {
    FloatLanes v;
    Float() = default;
    Float(float s) : v(s - FloatLanes{}) {}  // keeps -0, as a sum would not
    explicit Float(FloatLanes lanes) : v(lanes) {}
    explicit Float(Uint u);
    explicit Float(Int i);
    friend Float operator-(Float a) { return Float(-a.v); }
    friend Float operator/(Float a, Float b) { return Float(a.v / b.v); }
    friend Float min(Float a, Float b) { return Float(smaller(a.v, b.v)); }
    friend Float max(Float a, Float b) { return Float(larger(a.v, b.v)); }
    LANE_OPERATORS(Float)
};

struct Int {
    IntLanes v;
    Int() = default;
    Int(int32_t s) : v(IntLanes{} + s) {}
    explicit Int(uint32_t s) : v(IntLanes{} + static_cast<int32_t>(s)) {}
    explicit Int(IntLanes lanes) : v(lanes) {}
    explicit Int(Float f) : v(__builtin_convertvector(f.v, IntLanes)) {}
    explicit Int(Uint u);
    friend Int operator-(Int a) { return Int(-a.v); }
    friend Int operator>>(Int a, int n) { return Int(a.v >> n); }
    friend Int min(Int a, Int b) { return select(b < a, b, a); }
    friend Int max(Int a, Int b) { return select(a < b, b, a); }
    LANE_OPERATORS(Int)
};

struct Uint {
    UintLanes v;
    Uint() = default;
    Uint(uint32_t s) : v(UintLanes{} + s) {}
    explicit Uint(UintLanes lanes) : v(lanes) {}
    explicit Uint(Float f) : v(__builtin_convertvector(f.v, UintLanes)) {}
    explicit Uint(Int i) : v(__builtin_convertvector(i.v, UintLanes)) {}
    friend Uint operator/(Uint a, Uint b) { return Uint(quotient(a.v, b.v)); }
    friend Uint operator&(Uint a, Uint b) { return Uint(a.v & b.v); }
    friend Uint operator|(Uint a, Uint b) { return Uint(a.v | b.v); }
    friend Uint operator^(Uint a, Uint b) { return Uint(a.v ^ b.v); }
    friend Uint operator>>(Uint a, int n) { return Uint(a.v >> n); }
    friend Uint operator>>(Uint a, Uint n) { return Uint(a.v >> n.v); }
    friend Uint operator<<(Uint a, int n) { return Uint(a.v << n); }
    friend Uint min(Uint a, Uint b) { return select(b < a, b, a); }
    LANE_OPERATORS(Uint)
};
#undef LANE_OPERATORS

inline Float::Float(Uint u) : v(__builtin_convertvector(u.v, FloatLanes)) {}
inline Float::Float(Int i) : v(__builtin_convertvector(i.v, FloatLanes)) {}
inline Int::Int(Uint u) : v(__builtin_convertvector(u.v, IntLanes)) {}

using vec2 = Vec2<Float>;
using vec3 = Vec3<Float>;
using vec4 = Vec4<Float>;
using uvec4 = Vec4<Uint>;

inline vec2 select(Mask where, vec2 yes, vec2 no) { return {select(where, yes.x, no.x), select(where, yes.y, no.y)}; }
inline vec3 select(Mask where, vec3 yes, vec3 no) {
    return {select(where, yes.x, no.x), select(where, yes.y, no.y), select(where, yes.z, no.z)};
}
inline vec4 select(Mask where, vec4 yes, vec4 no) {
    return {select(where, yes.x, no.x), select(where, yes.y, no.y), select(where, yes.z, no.z),
            select(where, yes.w, no.w)};
}

inline bool any_lane(Mask where) { return mask_bits(where.v) != 0; }

inline Float uintBitsToFloat(Uint x) { return Float(std::bit_cast<FloatLanes>(x.v)); }
inline Uint floatBitsToUint(Float x) { return Uint(std::bit_cast<UintLanes>(x.v)); }
inline Float abs(Float x) { return uintBitsToFloat(floatBitsToUint(x) & 0x7fffffffu); }
inline Float sqrt(Float x) { return Float(root(x.v)); }
inline Float floor(Float x) { return Float(round_down(x.v)); }
inline vec3 min(vec3 a, vec3 b) { return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)}; }
inline Float clamp(Float x, Float low, Float high) { return min(max(x, low), high); }
inline Int clamp(Int x, Int low, Int high) { return min(max(x, low), high); }

inline Uint bitfieldReverse(Uint x) { return Uint(reversed_bits(x.v)); }

// ---- Jobs ----

constexpr uint ALL_LANES = (1u << LANES) - 1u;

/// Lanes that carry a job of their own. The others repeat the last job, so that all they read is there; they trace,
/// store and append nothing.
inline constinit thread_local uint active_lanes = ALL_LANES;

/// 0, 1, 2 and so on.
inline Uint lane_numbers() {
    Uint lanes;
    for (uint i = 0; i < LANES; ++i) lanes.v[i] = i;
    return lanes;
}

// Not where sanitizers look at each access: GCC then works for minutes on the one large function.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define INLINE_ALL_BELOW
#else
#define INLINE_ALL_BELOW [[gnu::flatten]]
#endif

/// Calls kernel(job) for every job below `count`, LANES at a time. All calls below it are inlined: structs of lanes are
/// kilobytes, and passing them costs more than what the functions do.
template <void (*kernel)(Uint)>
INLINE_ALL_BELOW void for_each_job(uint count) {
    for (uint job = 0; job < count; job += LANES) {
        active_lanes = count - job >= LANES ? ALL_LANES : (1u << (count - job)) - 1u;
        kernel(min(lane_numbers() + job, Uint(count - 1u)));
    }
}

// ---- Memory: a row per lane ----

struct alignas(64) LaneRows {
    float rows[LANES][4];
};

/// The lanes as words in memory, to be read one at a time: a load each is cheaper than what GCC makes of index.v[i],
/// which is a shuffle and a move. The empty statement keeps it from seeing through. Two words come with each load:
/// words that were just stored are slow to read back.
struct LaneWords {
    alignas(64) uint64_t pairs[LANES / 2];
    explicit LaneWords(Uint lanes) {
        __builtin_memcpy(pairs, &lanes.v, sizeof(pairs));
        asm("" : "+m"(pairs));
    }
    uint operator[](uint lane) const {
        uint64_t pair = pairs[lane / 2];
        return static_cast<uint>(lane % 2 == 0 ? pair : pair >> 32);
    }
};

/// Where the rows of an entry of a table begin: a row is 16 bytes, and addresses scale by 8 for free.
struct Rows {
    LaneWords halves;
    bool same;  // for all lanes
    explicit Rows(Uint first) : halves(first + first), same(!any_lane(first != Uint(first.v[0]))) {}
    const float* row(const target_core::vec4* table, uint lane) const {
        return reinterpret_cast<const float*>(table) + size_t{2} * halves[lane];
    }
    float* row(target_core::vec4* table, uint lane) const {
        return reinterpret_cast<float*>(table) + size_t{2} * halves[lane];
    }
};
inline Rows rows_from(Uint first) { return Rows(first); }

inline vec4 gather(const target_core::vec4* table, const Rows& first, uint offset) {
    vec4 row;
    load_rows([&](uint lane) { return first.row(table + offset, lane); }, row.x.v, row.y.v, row.z.v, row.w.v);
    return row;
}

/// gather() where lanes are likely to want the same row.
inline vec4 gather_shared(const target_core::vec4* table, const Rows& first, uint offset) {
    if (first.same) {
        uint words[4];  // bits: a row may hold integers
        __builtin_memcpy(words, first.row(table + offset, 0), sizeof(words));
        return {uintBitsToFloat(words[0]), uintBitsToFloat(words[1]), uintBitsToFloat(words[2]),
                uintBitsToFloat(words[3])};
    }
    return gather(table, first, offset);
}

inline vec4 gather(const target_core::vec4* rows, Uint index) { return gather(rows, Rows(index), 0); }

inline uvec4 bits_of(const vec4& row) {
    return {floatBitsToUint(row.x), floatBitsToUint(row.y), floatBitsToUint(row.z), floatBitsToUint(row.w)};
}

inline uvec4 gather(const target_core::uvec4* rows, Uint index) {
    return bits_of(gather(reinterpret_cast<const target_core::vec4*>(rows), index));
}

inline uvec4 gather_shared(const target_core::uvec4* rows, Uint index) {
    return bits_of(gather_shared(reinterpret_cast<const target_core::vec4*>(rows), Rows(index), 0));
}

inline Uint gather(const uint* words, Uint index) { return Uint(gather_words(words, index.v)); }

// Pixels of a plane. It goes on for a while before the first and behind the last one: there are zeros. Those of jobs
// follow each other, as their neighbours do: they are read and written as a whole. A last job that stands in for some
// counts as those that would follow, which are read, but never written.
struct Pixels {
    int first = 0;
    bool in_order = false;
    Uint index;  // of each, where they are not in order
};
inline Pixels pixels_from(Uint pixel) {
    const uint first = pixel.v[0];
    return {int(first), !any_lane(pixel != lane_numbers() + first), pixel};
}
inline Pixels pixels_in_order(Uint pixel) { return {int(pixel.v[0]), true, {}}; }
inline Pixels pixels_beside(const Pixels& pixels, int far) { return {pixels.first + far, true, {}}; }
inline Int pixel_row(const Pixels& pixels, uint width) {
    const uint first = uint(pixels.first), row = first / width;
    const Uint column = lane_numbers() + (first - row * width);
    if (width >= LANES) {
        return select(column < Uint(width), Int(row), Int(row + 1));
    }
    return Int(Uint(row) + column / Uint(width));
}
inline Int pixel_column(const Pixels& pixels, Int row, uint width) {
    return Int(lane_numbers() + uint(pixels.first)) - row * Int(width);
}

inline Float gather_plane(const float* plane, const Pixels& pixels) {
    Float value;
    if (pixels.in_order) {
        __builtin_memcpy(&value.v, plane + pixels.first, sizeof(value.v));
        return value;
    }
    return uintBitsToFloat(Uint(gather_words(reinterpret_cast<const uint*>(plane), pixels.index.v)));
}

/// Lanes in memory wherever a float may be. What is stored as these is floats to the compiler, as nothing copied byte
/// by byte is: what else a kernel has bound is not read again for every packet.
typedef float LooseFloatLanes __attribute__((vector_size(4 * LANES), aligned(4)));

inline void scatter_plane(float* plane, const Pixels& pixels, Float value) {
    if (active_lanes == ALL_LANES) {
        *reinterpret_cast<LooseFloatLanes*>(plane + pixels.first) = value.v;
        return;
    }
    for (uint left = active_lanes; left != 0; left &= left - 1) {
        const int lane = std::countr_zero(left);
        plane[pixels.first + lane] = value.v[lane];
    }
}

// Rows of pixels that follow each other.
inline vec4 gather_pixels(const target_core::vec4* rows, const Pixels& pixels) {
    const float* first = &rows[pixels.first].x;
    vec4 row;
    load_rows([&](uint lane) { return first + size_t{4} * lane; }, row.x.v, row.y.v, row.z.v, row.w.v);
    return row;
}

inline void scatter_pixels(target_core::vec4* rows, const Pixels& pixels, const vec4& row) {
    float* first = &rows[pixels.first].x;
    if (active_lanes == ALL_LANES) {
        store_rows([&](uint lane) { return first + 4 * lane; }, row.x.v, row.y.v, row.z.v, row.w.v);
        return;
    }
    for (uint left = active_lanes; left != 0; left &= left - 1) {
        const int lane = std::countr_zero(left);
        rows[pixels.first + lane] = {row.x.v[lane], row.y.v[lane], row.z.v[lane], row.w.v[lane]};
    }
}

// Rows of pixels in blocks: of TILE_GRAIN pixels that follow each other every component of every row is kept together.
// Pixels in order begin where LANES of a block do.
inline float* block_row(float* blocks, uint pixel, uint row, uint rows) {
    return blocks + (size_t{pixel / TILE_GRAIN} * rows + row) * (4 * TILE_GRAIN) + pixel % TILE_GRAIN;
}

inline vec4 gather_blocks(float* blocks, const Pixels& pixels, uint row, uint rows) {
    const float* first = block_row(blocks, uint(pixels.first), row, rows);
    vec4 found;
    __builtin_memcpy(&found.x.v, first, sizeof(found.x.v));
    __builtin_memcpy(&found.y.v, first + TILE_GRAIN, sizeof(found.y.v));
    __builtin_memcpy(&found.z.v, first + 2 * TILE_GRAIN, sizeof(found.z.v));
    __builtin_memcpy(&found.w.v, first + 3 * TILE_GRAIN, sizeof(found.w.v));
    return found;
}

/// Whether lanes have LANES pixels of one block, in order, and one row.
inline bool is_of_one_block(Uint pixel, Uint row) {
    const uint first = pixel.v[0];
    return first % LANES == 0 && !any_lane(pixel != lane_numbers() + first || row != Uint(row.v[0]));
}

inline vec4 gather_block_rows(float* blocks, Uint pixel, Uint row, uint rows) {
    if (is_of_one_block(pixel, row)) {
        return gather_blocks(blocks, pixels_in_order(pixel), row.v[0], rows);
    }
    const LaneWords pixels(pixel), lane_rows(row);
    alignas(64) float words[4][LANES];
    for (uint lane = 0; lane < LANES; ++lane) {
        const float* first = block_row(blocks, pixels[lane], lane_rows[lane], rows);
        for (uint i = 0; i < 4; ++i) words[i][lane] = first[i * TILE_GRAIN];
    }
    vec4 found;
    __builtin_memcpy(&found.x.v, words[0], sizeof(words[0]));
    __builtin_memcpy(&found.y.v, words[1], sizeof(words[1]));
    __builtin_memcpy(&found.z.v, words[2], sizeof(words[2]));
    __builtin_memcpy(&found.w.v, words[3], sizeof(words[3]));
    return found;
}

inline void add_to_block_rows(float* blocks, Uint pixel, Uint row, uint rows, const vec4& more, Mask where) {
    const uint set = mask_bits(where.v) & active_lanes;
    const FloatLanes* components[] = {&more.x.v, &more.y.v, &more.z.v, &more.w.v};
    if (set == ALL_LANES && is_of_one_block(pixel, row)) {
        float* first = block_row(blocks, pixel.v[0], row.v[0], rows);
        for (uint i = 0; i < 4; ++i) {
            FloatLanes sum;
            __builtin_memcpy(&sum, first + i * TILE_GRAIN, sizeof(sum));
            sum += *components[i];
            __builtin_memcpy(first + i * TILE_GRAIN, &sum, sizeof(sum));
        }
        return;
    }
    const LaneWords pixels(pixel), lane_rows(row);
    alignas(64) float words[4][LANES];
    for (uint i = 0; i < 4; ++i) __builtin_memcpy(words[i], components[i], sizeof(words[i]));
    for (uint left = set; left != 0; left &= left - 1) {
        const uint lane = static_cast<uint>(std::countr_zero(left));
        float* first = block_row(blocks, pixels[lane], lane_rows[lane], rows);
        for (uint i = 0; i < 4; ++i) first[i * TILE_GRAIN] += words[i][lane];
    }
}

// Rows of a tile by job. Jobs of all lanes follow each other, but for lanes without one.
inline vec4 gather_jobs(const target_core::vec4* rows, Uint job) {
    if (active_lanes != ALL_LANES) {
        return gather(rows, job);
    }
    const float* first = &rows[job.v[0]].x;
    vec4 row;
    load_rows([&](uint lane) { return first + 4 * lane; }, row.x.v, row.y.v, row.z.v, row.w.v);
    return row;
}

inline vec4 gather_jobs(const TileRows<target_core::vec4>& rows, Uint job) { return gather_jobs(rows.get(), job); }

inline uvec4 gather_jobs(const TileRows<target_core::uvec4>& rows, Uint job) {
    return bits_of(gather_jobs(reinterpret_cast<const target_core::vec4*>(rows.get()), job));
}

inline Mask active() { return Mask::of(mask_of_bits(active_lanes)); }

inline void scatter(target_core::vec4* rows, Uint index, const vec4& row, Mask where) {
    Rows places(index);
    if ((mask_bits(where.v) & active_lanes) == ALL_LANES) {
        store_rows([&](uint lane) { return places.row(rows, lane); }, row.x.v, row.y.v, row.z.v, row.w.v);
        return;
    }
    LaneRows lanes;
    store_rows([&](uint lane) { return lanes.rows[lane]; }, row.x.v, row.y.v, row.z.v, row.w.v);
    for (uint left = mask_bits(where.v) & active_lanes; left != 0; left &= left - 1) {
        uint lane = static_cast<uint>(std::countr_zero(left));
        __builtin_memcpy(places.row(rows, lane), lanes.rows[lane], sizeof(lanes.rows[lane]));
    }
}

// Rows of a tile to store to. A tile has a spare row: lanes with nothing to store write there, which is cheaper than to
// ask each of them.
using Places = Rows;
inline Places places_of(Uint row, Mask where) { return Rows(select(where && active(), row, Uint(TILE_PATHS))); }

inline void scatter(const TileRows<target_core::vec4>& rows, const Places& places, const vec4& row) {
    store_rows([&](uint lane) { return places.row(rows.get(), lane); }, row.x.v, row.y.v, row.z.v, row.w.v);
}

// Appends LANES rows and counts those that are set, which come first; the spare rows take what is too much.
inline uint append(float* end, uint length, const vec4& row, Mask kept) {
    store_rows([&](uint lane) { return end + 4 * lane; }, packed(kept.v, row.x.v), packed(kept.v, row.y.v),
               packed(kept.v, row.z.v), packed(kept.v, row.w.v));
    return length + static_cast<uint>(std::popcount(mask_bits(kept.v)));
}

inline uint compact(const TileRows<target_core::vec4>& rows, uint length, const vec4& row, Mask where) {
    return append(&rows[length].x, length, row, where && active());
}

inline uint compact(const TileRows<target_core::uvec4>& rows, uint length, const uvec4& row, Mask where) {
    vec4 bits = {uintBitsToFloat(row.x), uintBitsToFloat(row.y), uintBitsToFloat(row.z), uintBitsToFloat(row.w)};
    return append(reinterpret_cast<float*>(&rows[length]), length, bits, where && active());
}

inline uint compact(const TileRows<uint>& words, uint length, Uint word, Mask where) {
    Mask kept = where && active();
    FloatLanes first = packed(kept.v, uintBitsToFloat(word).v);
    __builtin_memcpy(&words[length], &first, sizeof(first));
    return length + static_cast<uint>(std::popcount(mask_bits(kept.v)));
}

}  // namespace target_core::kernels
