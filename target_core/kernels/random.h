// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/random.glsl.
#pragma once

#include "target_core/kernels/math.h"

namespace target_core::kernels {

// Random numbers are a pure function of (pixel, sample, dimension, seed): no state, so the order in which rays are
// handled never matters. Order of draws at path vertex k (the contract between the cores): the pairs below.

const uint PAIR_PIXEL = 0u;        // position inside the pixel
const uint PAIR_LENS = 1u;         // and on the lens
const uint PAIRS_PER_VERTEX = 5u;  // vertex k, from 1, uses pairs k * PAIRS_PER_VERTEX + ...
const uint PAIR_BSDF = 0u;         // direction of the next segment
const uint PAIR_LOBE = 1u;         // x: lobe, y: Russian roulette
const uint PAIR_LIGHT = 2u;        // point on the light
const uint PAIR_LIGHT_PICK = 3u;   // entry and fraction of the light table
const uint PAIR_SKY_PICK = 4u;     // entry and fraction of the sky table

// Bijective hash of 32 bits (Wellons, "lowbias32").
inline Uint hash_bits(Uint x) {
    x = x ^ (x >> 16);
    x = x * 0x7feb352du;
    x = x ^ (x >> 15);
    x = x * 0x846ca68bu;
    x = x ^ (x >> 16);
    return x;
}

inline Uint hash_pair(Uint a, Uint b) { return hash_bits(a ^ (hash_bits(b) + 0x9e3779b9u)); }

// 24 bits to [0, 1).
inline Float unit_float(Uint bits) { return Float(bits >> 8) * 5.9604644775390625e-8f; }

// Owen scrambling of a number whose bits are reversed: Laine and Karras 2011, with the constants of Vegdahl 2021.
inline Uint scramble_reversed(Uint x, Uint seed) {
    x = x ^ (x * 0x3d20adeau);
    x = x + seed;
    x = x * ((seed >> 16) | 1u);
    x = x ^ (x * 0x05526c56u);
    x = x ^ (x * 0x53a22864u);
    return x;
}

// Second dimension of the Sobol sequence, bits reversed: the Pascal matrix modulo 2, as a butterfly.
inline Uint sobol_second_reversed(Uint index) {
    Uint x = index;
    x = x ^ ((x >> 1) & 0x55555555u);
    x = x ^ ((x >> 2) & 0x33333333u);
    x = x ^ ((x >> 4) & 0x0f0f0f0fu);
    x = x ^ ((x >> 8) & 0x00ff00ffu);
    x = x ^ ((x >> 16) & 0x0000ffffu);
    return x;
}

// The stream of one pixel.
inline Uint pixel_seed(Uint pixel, uint seed) { return hash_pair(pixel, hash_bits(seed)); }

// Two random numbers in [0, 1): an Owen-scrambled Sobol point, its index shuffled per pair so that pairs are
// independent of each other (Burley 2020, "Practical Hash-based Owen Scrambling").
inline vec2 random_pair(Uint stream, uint sample_index, uint pair) {
    Uint seed = hash_pair(stream, pair);
    Uint index = bitfieldReverse(scramble_reversed(bitfieldReverse(sample_index), seed));
    Uint x = bitfieldReverse(scramble_reversed(index, hash_bits(seed ^ 0x5851f42du)));
    Uint y = bitfieldReverse(scramble_reversed(sobol_second_reversed(index), hash_bits(seed ^ 0x14057b7eu)));
    return vec2(unit_float(x), unit_float(y));
}

}  // namespace target_core::kernels
