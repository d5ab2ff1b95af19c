// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Sixteen lanes on AVX-512. What differs between instruction sets is here; the rest is in wide_lanes.h.
#pragma once

#include <immintrin.h>

#include <cstdint>

#include "target_core/device/glsl.h"

namespace target_core::kernels {

constexpr uint LANES = 16;

typedef float FloatLanes __attribute__((vector_size(64)));
typedef uint32_t UintLanes __attribute__((vector_size(64)));
typedef int32_t IntLanes __attribute__((vector_size(64)));

/// One bit a lane.
using MaskLanes = __mmask16;

inline MaskLanes mask_of(bool set) { return static_cast<MaskLanes>(set ? 0xFFFFu : 0u); }
inline MaskLanes mask_of_bits(uint bits) { return static_cast<MaskLanes>(bits); }
inline uint mask_bits(MaskLanes mask) { return mask; }
inline MaskLanes inverted(MaskLanes a) { return static_cast<MaskLanes>(~a); }
inline MaskLanes both(MaskLanes a, MaskLanes b) { return static_cast<MaskLanes>(a & b); }
inline MaskLanes either(MaskLanes a, MaskLanes b) { return static_cast<MaskLanes>(a | b); }
inline MaskLanes differ(MaskLanes a, MaskLanes b) { return static_cast<MaskLanes>(a ^ b); }
/// The mask as Embree takes it: -1 or 0 a lane.
inline IntLanes mask_words(MaskLanes mask) { return (IntLanes)_mm512_movm_epi32(mask); }

inline MaskLanes less(FloatLanes a, FloatLanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
inline MaskLanes less_equal(FloatLanes a, FloatLanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
inline MaskLanes equal(FloatLanes a, FloatLanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ); }
inline MaskLanes less(IntLanes a, IntLanes b) { return _mm512_cmplt_epi32_mask((__m512i)a, (__m512i)b); }
inline MaskLanes less_equal(IntLanes a, IntLanes b) { return _mm512_cmple_epi32_mask((__m512i)a, (__m512i)b); }
inline MaskLanes equal(IntLanes a, IntLanes b) { return _mm512_cmpeq_epi32_mask((__m512i)a, (__m512i)b); }
inline MaskLanes less(UintLanes a, UintLanes b) { return _mm512_cmplt_epu32_mask((__m512i)a, (__m512i)b); }
inline MaskLanes less_equal(UintLanes a, UintLanes b) { return _mm512_cmple_epu32_mask((__m512i)a, (__m512i)b); }
inline MaskLanes equal(UintLanes a, UintLanes b) { return _mm512_cmpeq_epu32_mask((__m512i)a, (__m512i)b); }

inline FloatLanes blend_lanes(MaskLanes where, FloatLanes yes, FloatLanes no) {
    return _mm512_mask_blend_ps(where, no, yes);
}
inline IntLanes blend_lanes(MaskLanes where, IntLanes yes, IntLanes no) {
    return (IntLanes)_mm512_mask_blend_epi32(where, (__m512i)no, (__m512i)yes);
}
inline UintLanes blend_lanes(MaskLanes where, UintLanes yes, UintLanes no) {
    return (UintLanes)_mm512_mask_blend_epi32(where, (__m512i)no, (__m512i)yes);
}

// As the scalar text has them: `b < a ? b : a` and `a < b ? b : a`.
inline FloatLanes smaller(FloatLanes a, FloatLanes b) { return _mm512_min_ps(b, a); }
inline FloatLanes larger(FloatLanes a, FloatLanes b) { return _mm512_max_ps(b, a); }
inline FloatLanes root(FloatLanes a) { return _mm512_sqrt_ps(a); }
inline FloatLanes round_down(FloatLanes a) {
    return _mm512_roundscale_ps(a, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
}

/// Bits in reverse order: those of half a byte by a table, the bytes by a shuffle.
inline UintLanes reversed_bits(UintLanes x) {
    const __m512i low = _mm512_set1_epi32(0x0f0f0f0f);
    const __m512i table = _mm512_broadcast_i32x4(_mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15));
    const __m512i swap = _mm512_broadcast_i32x4(_mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12));
    __m512i high_half = _mm512_shuffle_epi8(table, _mm512_and_si512((__m512i)x, low));
    __m512i low_half = _mm512_shuffle_epi8(table, _mm512_and_si512((__m512i)(x >> 4), low));
    return (UintLanes)_mm512_shuffle_epi8(_mm512_or_si512(_mm512_slli_epi32(high_half, 4), low_half), swap);
}

/// Exact: the next integer is at least 1 / b away, and a double rounds by less. Only scalars trap on a division by 0.
inline UintLanes quotient(UintLanes a, UintLanes b) {
    auto half = [](__m256i x, __m256i y) {
        return _mm512_cvttpd_epu32(_mm512_div_pd(_mm512_cvtepu32_pd(x), _mm512_cvtepu32_pd(y)));
    };
    __m256i low = half(_mm512_castsi512_si256((__m512i)a), _mm512_castsi512_si256((__m512i)b));
    __m256i high = half(_mm512_extracti64x4_epi64((__m512i)a, 1), _mm512_extracti64x4_epi64((__m512i)b, 1));
    return (UintLanes)_mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1);
}

inline UintLanes gather_words(const uint* words, UintLanes index) {
    return (UintLanes)_mm512_i32gather_epi32((__m512i)index, words, 4);
}

/// A row of four floats from each of sixteen places, as four vectors of one component each. `row_of(i)` is the address
/// of that of lane i.
template <class RowOf>
inline void load_rows(const RowOf& row_of, FloatLanes& x, FloatLanes& y, FloatLanes& z, FloatLanes& w) {
    // Quarter k of row_j is the row of lane 4 k + j, so that each quarter is transposed by itself.
    auto quarters = [&](uint j) {
        __m512 row = _mm512_castps128_ps512(_mm_loadu_ps(row_of(j)));
        row = _mm512_insertf32x4(row, _mm_loadu_ps(row_of(4 + j)), 1);
        row = _mm512_insertf32x4(row, _mm_loadu_ps(row_of(8 + j)), 2);
        return _mm512_insertf32x4(row, _mm_loadu_ps(row_of(12 + j)), 3);
    };
    __m512 row0 = quarters(0), row1 = quarters(1), row2 = quarters(2), row3 = quarters(3);
    __m512 xy01 = _mm512_unpacklo_ps(row0, row1), zw01 = _mm512_unpackhi_ps(row0, row1);
    __m512 xy23 = _mm512_unpacklo_ps(row2, row3), zw23 = _mm512_unpackhi_ps(row2, row3);
    x = _mm512_shuffle_ps(xy01, xy23, 0x44);
    y = _mm512_shuffle_ps(xy01, xy23, 0xEE);
    z = _mm512_shuffle_ps(zw01, zw23, 0x44);
    w = _mm512_shuffle_ps(zw01, zw23, 0xEE);
}

/// The reverse: a row to each of sixteen places.
template <class RowOf>
inline void store_rows(const RowOf& row_of, FloatLanes x, FloatLanes y, FloatLanes z, FloatLanes w) {
    __m512 xy01 = _mm512_unpacklo_ps(x, y), xy23 = _mm512_unpackhi_ps(x, y);
    __m512 zw01 = _mm512_unpacklo_ps(z, w), zw23 = _mm512_unpackhi_ps(z, w);
    auto put = [&](uint j, __m512 row) {
        _mm_storeu_ps(row_of(j), _mm512_castps512_ps128(row));
        _mm_storeu_ps(row_of(4 + j), _mm512_extractf32x4_ps(row, 1));
        _mm_storeu_ps(row_of(8 + j), _mm512_extractf32x4_ps(row, 2));
        _mm_storeu_ps(row_of(12 + j), _mm512_extractf32x4_ps(row, 3));
    };
    put(0, _mm512_shuffle_ps(xy01, zw01, 0x44));
    put(1, _mm512_shuffle_ps(xy01, zw01, 0xEE));
    put(2, _mm512_shuffle_ps(xy23, zw23, 0x44));
    put(3, _mm512_shuffle_ps(xy23, zw23, 0xEE));
}

/// The lanes of the mask, moved together to the front.
inline FloatLanes packed(MaskLanes where, FloatLanes lanes) { return _mm512_maskz_compress_ps(where, lanes); }

}  // namespace target_core::kernels

#include "target_core/device/wide_lanes.h"
