// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// A backend of eight lanes for the kernel text, on GCC vector extensions: the proof that the text needs no change to
// run wide. It is put in place of the scalar one by TARGET_CORE_LANES; see target_core/device/lanes.h.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "target_core/device/glsl.h"

namespace target_core::kernels {

constexpr int LANES = 8;

typedef float FloatLanes __attribute__((vector_size(32)));
typedef uint32_t UintLanes __attribute__((vector_size(32)));
typedef int32_t IntLanes __attribute__((vector_size(32)));

struct Mask {
    IntLanes v;
    Mask() = default;
    Mask(bool b) : v(IntLanes{} - (b ? 1 : 0)) {}
    explicit Mask(IntLanes lanes) : v(lanes) {}
    friend Mask operator!(Mask a) { return Mask(~a.v); }
    friend Mask operator&&(Mask a, Mask b) { return Mask(a.v & b.v); }
    friend Mask operator||(Mask a, Mask b) { return Mask(a.v | b.v); }
    friend Mask operator==(Mask a, Mask b) { return Mask(~(a.v ^ b.v)); }
    friend Mask operator!=(Mask a, Mask b) { return Mask(a.v ^ b.v); }
};

// The operators that Float, Uint and Int share.
#define LANE_OPERATORS(Type, Lanes)                                                \
    friend Type operator+(Type a, Type b) { return Type(a.v + b.v); }              \
    friend Type operator-(Type a, Type b) { return Type(a.v - b.v); }              \
    friend Type operator*(Type a, Type b) { return Type(a.v * b.v); }              \
    friend Type operator/(Type a, Type b) { return Type(a.v / b.v); }              \
    friend Mask operator<(Type a, Type b) { return Mask(IntLanes(a.v < b.v)); }    \
    friend Mask operator>(Type a, Type b) { return Mask(IntLanes(a.v > b.v)); }    \
    friend Mask operator<=(Type a, Type b) { return Mask(IntLanes(a.v <= b.v)); }  \
    friend Mask operator>=(Type a, Type b) { return Mask(IntLanes(a.v >= b.v)); }  \
    friend Mask operator==(Type a, Type b) { return Mask(IntLanes(a.v == b.v)); }  \
    friend Mask operator!=(Type a, Type b) { return Mask(IntLanes(a.v != b.v)); }  \
    friend Type min(Type a, Type b) { return Type(Lanes(b.v < a.v ? b.v : a.v)); } \
    friend Type max(Type a, Type b) { return Type(Lanes(a.v < b.v ? b.v : a.v)); } \
    friend Type select(Mask m, Type a, Type b) { return Type(Lanes(m.v ? a.v : b.v)); }

struct Uint;
struct Int;

struct Float {
    FloatLanes v;
    Float() = default;
    Float(float s) : v(FloatLanes{} + s) {}
    explicit Float(FloatLanes lanes) : v(lanes) {}
    explicit Float(Uint u);
    explicit Float(Int i);
    friend Float operator-(Float a) { return Float(-a.v); }
    LANE_OPERATORS(Float, FloatLanes)
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
    LANE_OPERATORS(Int, IntLanes)
};

struct Uint {
    UintLanes v;
    Uint() = default;
    Uint(uint32_t s) : v(UintLanes{} + s) {}
    explicit Uint(UintLanes lanes) : v(lanes) {}
    explicit Uint(Float f) : v(__builtin_convertvector(f.v, UintLanes)) {}
    explicit Uint(Int i) : v(__builtin_convertvector(i.v, UintLanes)) {}
    friend Uint operator&(Uint a, Uint b) { return Uint(a.v & b.v); }
    friend Uint operator|(Uint a, Uint b) { return Uint(a.v | b.v); }
    friend Uint operator^(Uint a, Uint b) { return Uint(a.v ^ b.v); }
    friend Uint operator>>(Uint a, int n) { return Uint(a.v >> n); }
    friend Uint operator<<(Uint a, int n) { return Uint(a.v << n); }
    LANE_OPERATORS(Uint, UintLanes)
};
#undef LANE_OPERATORS

inline Float::Float(Uint u) : v(__builtin_convertvector(u.v, FloatLanes)) {}
inline Float::Float(Int i) : v(__builtin_convertvector(i.v, FloatLanes)) {}
inline Int::Int(Uint u) : v(__builtin_convertvector(u.v, IntLanes)) {}

using vec2 = Vec2<Float>;
using vec3 = Vec3<Float>;
using vec4 = Vec4<Float>;
using uvec4 = Vec4<Uint>;

inline vec2 select(Mask m, vec2 a, vec2 b) { return {select(m, a.x, b.x), select(m, a.y, b.y)}; }
inline vec3 select(Mask m, vec3 a, vec3 b) { return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)}; }
inline vec4 select(Mask m, vec4 a, vec4 b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z), select(m, a.w, b.w)};
}

inline bool any_lane(Mask where) {
    for (int i = 0; i < LANES; ++i) {
        if (where.v[i] != 0) {
            return true;
        }
    }
    return false;
}

inline Float uintBitsToFloat(Uint x) { return Float(std::bit_cast<FloatLanes>(x.v)); }
inline Uint floatBitsToUint(Float x) { return Uint(std::bit_cast<UintLanes>(x.v)); }
inline Float abs(Float x) { return uintBitsToFloat(floatBitsToUint(x) & 0x7fffffffu); }
inline Float sqrt(Float x) {
    for (int i = 0; i < LANES; ++i) {
        x.v[i] = std::sqrt(x.v[i]);
    }
    return x;
}
inline Float floor(Float x) {
    for (int i = 0; i < LANES; ++i) {
        x.v[i] = std::floor(x.v[i]);
    }
    return x;
}
inline vec3 min(vec3 a, vec3 b) { return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)}; }
inline Float clamp(Float x, Float low, Float high) { return min(max(x, low), high); }

inline Uint bitfieldReverse(Uint x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

// ---- Lanes of rows, and rows in memory ----

template <class Wide, class Narrow>
inline void set_lane(Vec4<Wide>& wide, int lane, const Vec4<Narrow>& row) {
    wide.x.v[lane] = row.x;
    wide.y.v[lane] = row.y;
    wide.z.v[lane] = row.z;
    wide.w.v[lane] = row.w;
}

inline vec4 gather(const target_core::vec4* rows, Uint index) {
    vec4 result;
    for (int i = 0; i < LANES; ++i) {
        set_lane(result, i, rows[index.v[i]]);
    }
    return result;
}
inline uvec4 gather(const target_core::uvec4* rows, Uint index) {
    uvec4 result;
    for (int i = 0; i < LANES; ++i) {
        set_lane(result, i, rows[index.v[i]]);
    }
    return result;
}
inline Uint gather(const uint* words, Uint index) {
    Uint result;
    for (int i = 0; i < LANES; ++i) {
        result.v[i] = words[index.v[i]];
    }
    return result;
}

inline void put(target_core::vec4& row, const vec4& wide, int i) {
    row = {wide.x.v[i], wide.y.v[i], wide.z.v[i], wide.w.v[i]};
}
inline void put(target_core::uvec4& row, const uvec4& wide, int i) {
    row = {wide.x.v[i], wide.y.v[i], wide.z.v[i], wide.w.v[i]};
}
inline void put(uint& word, const Uint& wide, int i) { word = wide.v[i]; }

template <class Row, class Wide>
inline void scatter(Row* rows, Uint index, const Wide& wide, Mask where) {
    for (int i = 0; i < LANES; ++i) {
        if (where.v[i] != 0) {
            put(rows[index.v[i]], wide, i);
        }
    }
}

template <class Row, class Wide>
inline uint compact(Row* rows, uint length, const Wide& wide, Mask where) {
    for (int i = 0; i < LANES; ++i) {
        if (where.v[i] != 0) {
            put(rows[length++], wide, i);
        }
    }
    return length;
}

}  // namespace target_core::kernels
