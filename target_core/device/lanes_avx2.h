// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Eight lanes on AVX2. What differs between instruction sets is here; the rest is in wide_lanes.h.
#pragma once

#include <immintrin.h>

#include <cstdint>

#include "target_core/device/glsl.h"

namespace target_core::kernels {

constexpr uint LANES = 8;

typedef float FloatLanes __attribute__((vector_size(32)));
typedef uint32_t UintLanes __attribute__((vector_size(32)));
typedef int32_t IntLanes __attribute__((vector_size(32)));

/// All bits of a lane set, or none.
using MaskLanes = IntLanes;

inline MaskLanes mask_of(bool set) { return IntLanes{} - (set ? 1 : 0); }
inline MaskLanes mask_of_bits(uint bits) {
    const IntLanes bit = {1, 2, 4, 8, 16, 32, 64, 128};
    return ((IntLanes{} + static_cast<int32_t>(bits)) & bit) == bit;
}
inline uint mask_bits(MaskLanes mask) {
    return static_cast<uint>(_mm256_movemask_ps(_mm256_castsi256_ps((__m256i)mask)));
}
inline MaskLanes inverted(MaskLanes a) { return ~a; }
inline MaskLanes both(MaskLanes a, MaskLanes b) { return a & b; }
inline MaskLanes either(MaskLanes a, MaskLanes b) { return a | b; }
inline MaskLanes differ(MaskLanes a, MaskLanes b) { return a ^ b; }
/// The mask as Embree takes it: -1 or 0 a lane.
inline IntLanes mask_words(MaskLanes mask) { return mask; }

template <class Lanes>
inline MaskLanes less(Lanes a, Lanes b) {
    return a < b;
}
template <class Lanes>
inline MaskLanes less_equal(Lanes a, Lanes b) {
    return a <= b;
}
template <class Lanes>
inline MaskLanes equal(Lanes a, Lanes b) {
    return a == b;
}

template <class Lanes>
inline Lanes blend_lanes(MaskLanes where, Lanes yes, Lanes no) {
    return (Lanes)_mm256_blendv_ps((__m256)no, (__m256)yes, (__m256)where);
}

// As the scalar text has them: `b < a ? b : a` and `a < b ? b : a`.
inline FloatLanes smaller(FloatLanes a, FloatLanes b) { return _mm256_min_ps(b, a); }
inline FloatLanes larger(FloatLanes a, FloatLanes b) { return _mm256_max_ps(b, a); }
inline FloatLanes root(FloatLanes a) { return _mm256_sqrt_ps(a); }
inline FloatLanes round_down(FloatLanes a) { return _mm256_floor_ps(a); }

/// Bits in reverse order: those of half a byte by a table, the bytes by a shuffle.
inline UintLanes reversed_bits(UintLanes x) {
    const __m256i low = _mm256_set1_epi32(0x0f0f0f0f);
    const __m256i table =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15));
    const __m256i swap =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12));
    __m256i high_half = _mm256_shuffle_epi8(table, _mm256_and_si256((__m256i)x, low));
    __m256i low_half = _mm256_shuffle_epi8(table, _mm256_and_si256((__m256i)(x >> 4), low));
    return (UintLanes)_mm256_shuffle_epi8(_mm256_or_si256(_mm256_slli_epi32(high_half, 4), low_half), swap);
}

inline UintLanes quotient(UintLanes a, UintLanes b) { return a / b; }

inline UintLanes gather_words(const uint* words, UintLanes index) {
    return (UintLanes)_mm256_i32gather_epi32(reinterpret_cast<const int*>(words), (__m256i)index, 4);
}

/// A row of four floats from each of eight places, as four vectors of one component each. `row_of(i)` is the address of
/// that of lane i.
template <class RowOf>
inline void load_rows(const RowOf& row_of, FloatLanes& x, FloatLanes& y, FloatLanes& z, FloatLanes& w) {
    // Half k of row_j is the row of lane 4 k + j, so that each half is transposed by itself.
    auto halves = [&](uint j) {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(row_of(j))), _mm_loadu_ps(row_of(4 + j)), 1);
    };
    __m256 row0 = halves(0), row1 = halves(1), row2 = halves(2), row3 = halves(3);
    __m256 xy01 = _mm256_unpacklo_ps(row0, row1), zw01 = _mm256_unpackhi_ps(row0, row1);
    __m256 xy23 = _mm256_unpacklo_ps(row2, row3), zw23 = _mm256_unpackhi_ps(row2, row3);
    x = _mm256_shuffle_ps(xy01, xy23, 0x44);
    y = _mm256_shuffle_ps(xy01, xy23, 0xEE);
    z = _mm256_shuffle_ps(zw01, zw23, 0x44);
    w = _mm256_shuffle_ps(zw01, zw23, 0xEE);
}

/// The reverse: a row to each of eight places.
template <class RowOf>
inline void store_rows(const RowOf& row_of, FloatLanes x, FloatLanes y, FloatLanes z, FloatLanes w) {
    __m256 xy01 = _mm256_unpacklo_ps(x, y), xy23 = _mm256_unpackhi_ps(x, y);
    __m256 zw01 = _mm256_unpacklo_ps(z, w), zw23 = _mm256_unpackhi_ps(z, w);
    auto put = [&](uint j, __m256 row) {
        _mm_storeu_ps(row_of(j), _mm256_castps256_ps128(row));
        _mm_storeu_ps(row_of(4 + j), _mm256_extractf128_ps(row, 1));
    };
    put(0, _mm256_shuffle_ps(xy01, zw01, 0x44));
    put(1, _mm256_shuffle_ps(xy01, zw01, 0xEE));
    put(2, _mm256_shuffle_ps(xy23, zw23, 0x44));
    put(3, _mm256_shuffle_ps(xy23, zw23, 0xEE));
}

/// For each mask of eight lanes, the lanes that are set, three bits each, first ones lowest.
struct PackTable {
    uint order[256];
    constexpr PackTable() : order() {
        for (uint mask = 0; mask < 256; ++mask) {
            uint place = 0;
            for (uint lane = 0; lane < 8; ++lane) {
                if ((mask >> lane & 1u) != 0) order[mask] |= lane << (3 * place++);
            }
        }
    }
};
inline constexpr PackTable PACK_TABLE;

/// The lanes of the mask, moved together to the front.
inline FloatLanes packed(MaskLanes where, FloatLanes lanes) {
    const UintLanes shifts = {0, 3, 6, 9, 12, 15, 18, 21};
    UintLanes order = ((UintLanes{} + PACK_TABLE.order[mask_bits(where)]) >> shifts) & 7;
    return _mm256_permutevar8x32_ps(lanes, (__m256i)order);
}

}  // namespace target_core::kernels

#include "target_core/device/wide_lanes.h"
