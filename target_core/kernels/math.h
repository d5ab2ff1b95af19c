// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/math.glsl.
#pragma once

#include "target_core/device/lanes.h"

namespace target_core::kernels {

// Functions whose built-in versions differ between devices in their last bits are written out here, so that both
// cores compute the same bits: only + - * / sqrt, comparisons and bit casts are used. Constants are not multiplied with
// each other: a GLSL compiler folds them in double precision, a C++ compiler in float.

const float PI = 3.14159265358979f;
const float INVERSE_PI = 0.318309886183791f;
const float INVERSE_TWO_PI = 0.159154943091895f;
const float HALF_PI = 1.57079632679490f;
const float TWO_PI_SQUARED = 19.7392088021787f;
const float SMALLEST = 1.0e-30f;

inline Float square(Float x) { return x * x; }

inline Float saturate(Float x) { return clamp(x, 0.0f, 1.0f); }

inline Float max_component(vec3 v) { return max(max(v.x, v.y), v.z); }

inline Float luminance(vec3 rgb) { return (0.2126f * rgb.x + 0.7152f * rgb.y) + 0.0722f * rgb.z; }

inline Float blend(Float a, Float b, Float t) { return a + (b - a) * t; }

inline vec3 blend(vec3 a, vec3 b, Float t) { return a + (b - a) * t; }

inline vec4 blend(vec4 a, vec4 b, Float t) { return a + (b - a) * t; }

inline vec2 blend(vec2 a, vec2 b, Float t) { return a + (b - a) * t; }

// The vector at length 1; the zero vector stays zero.
inline vec3 normalized(vec3 v) { return v * (1.0f / sqrt(max(dot(v, v), SMALLEST))); }

// Cosine and sine of a full turn times `turns`, for turns in [0, 1]. Reduced to an eighth of a turn, then Taylor
// polynomials of degree 8 and 9: within 4e-7 of the true value.
inline vec2 cos_sin_turns(Float turns) {
    Float quarters = turns * 4.0f;
    Float nearest = floor(quarters + 0.5f);
    Float x = (quarters - nearest) * HALF_PI;
    Float x2 = x * x;
    Float sine =
        x * (1.0f + x2 * (-0.166666667f + x2 * (8.33333333e-3f + x2 * (-1.98412698e-4f + x2 * 2.75573192e-6f))));
    Float cosine = 1.0f + x2 * (-0.5f + x2 * (4.16666667e-2f + x2 * (-1.38888889e-3f + x2 * 2.48015873e-5f)));
    Uint quadrant = Uint(nearest) & 3u;
    Mask swapped = (quadrant & 1u) != 0u;
    Float c = select(swapped, sine, cosine);
    Float s = select(swapped, cosine, sine);
    Mask negative_c = quadrant == 1u || quadrant == 2u;
    Mask negative_s = quadrant >= 2u;
    return vec2(select(negative_c, -c, c), select(negative_s, -s, s));
}

// Arc cosine for x in [-1, 1], in radians; Abramowitz and Stegun 4.4.46, within 1e-6.
inline Float arc_cosine(Float x) {
    Float a = min(abs(x), 1.0f);
    Float p = -0.0012624911f;
    p = p * a + 0.0066700901f;
    p = p * a - 0.0170881256f;
    p = p * a + 0.0308918810f;
    p = p * a - 0.0501743046f;
    p = p * a + 0.0889789874f;
    p = p * a - 0.2145988016f;
    p = p * a + 1.5707963050f;
    Float positive = p * sqrt(1.0f - a);
    return select(x < 0.0f, PI - positive, positive);
}

// Angle of the point (x, y) in (-pi, pi]; Abramowitz and Stegun 4.4.49 after reduction to [0, 1]. 0 at the origin.
inline Float arc_tangent(Float y, Float x) {
    Float ax = abs(x);
    Float ay = abs(y);
    Float t = min(ax, ay) / max(max(ax, ay), SMALLEST);
    Float t2 = t * t;
    Float p = 0.0028662257f;
    p = p * t2 - 0.0161657367f;
    p = p * t2 + 0.0429096138f;
    p = p * t2 - 0.0752896400f;
    p = p * t2 + 0.1065626393f;
    p = p * t2 - 0.1420889944f;
    p = p * t2 + 0.1999355085f;
    p = p * t2 - 0.3333314528f;
    p = p * t2 + 1.0f;
    Float angle = p * t;
    angle = select(ay > ax, HALF_PI - angle, angle);
    angle = select(x < 0.0f, PI - angle, angle);
    return select(y < 0.0f, -angle, angle);
}

// Binary logarithm of a positive normal number, within 2e-7 relative to max(1, |log2 x|): exponent from the bits,
// mantissa in [sqrt(1/2), sqrt(2)) by the series of the inverse hyperbolic tangent.
inline Float log_2(Float x) {
    Uint bits = floatBitsToUint(x);
    Uint shifted = bits - 0x3f3504f3u;
    Int exponent = Int(shifted) >> 23;
    Float mantissa = uintBitsToFloat((shifted & 0x007fffffu) + 0x3f3504f3u);
    Float t = (mantissa - 1.0f) / (mantissa + 1.0f);
    Float t2 = t * t;
    Float p = 2.88539008f * t * (1.0f + t2 * (0.333333333f + t2 * (0.2f + t2 * (0.142857143f + t2 * 0.111111111f))));
    return Float(exponent) + p;
}

// Two to the power of x, for x from -126 to 127, within 2e-7 of its value: the whole part makes the exponent, the rest
// of at most 1/2 goes through a Taylor polynomial of degree 6.
inline Float exp_2(Float x) {
    Float nearest = floor(x + 0.5f);
    Float t = x - nearest;
    Float p = 9.61812911e-3f + t * (1.33335581e-3f + t * 1.54035304e-4f);
    p = 1.0f + t * (0.693147181f + t * (0.240226507f + t * (5.55041087e-2f + t * p)));
    return p * uintBitsToFloat(Uint(Int(nearest) + 127) << 23);
}

// x to the power of y, for x in (0, 1] and a power that exp_2 can hold.
inline Float power(Float x, Float y) { return exp_2(max(y * log_2(max(x, SMALLEST)), -126.0f)); }

// An orthonormal frame around a unit normal: Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
struct Frame {
    vec3 tangent;
    vec3 bitangent;
    vec3 normal;
};

inline Frame frame_around(vec3 normal) {
    Float side = select(normal.z < 0.0f, Float(-1.0f), Float(1.0f));
    Float a = -1.0f / (side + normal.z);
    Float b = normal.x * normal.y * a;
    Frame frame;
    frame.tangent = vec3(1.0f + side * normal.x * normal.x * a, side * b, -side * normal.x);
    frame.bitangent = vec3(b, side + normal.y * normal.y * a, -normal.y);
    frame.normal = normal;
    return frame;
}

// The same with its tangent along `along`, as far as that is at a right angle to the normal; without such a part, any.
inline Frame frame_along(vec3 normal, vec3 along) {
    Frame frame = frame_around(normal);
    vec3 flat_part = along - normal * dot(normal, along);
    Mask usable = dot(flat_part, flat_part) > 1.0e-6f;
    frame.tangent = select(usable, normalized(flat_part), frame.tangent);
    frame.bitangent = select(usable, cross(normal, frame.tangent), frame.bitangent);
    return frame;
}

inline vec3 to_local(Frame frame, vec3 v) {
    return vec3(dot(v, frame.tangent), dot(v, frame.bitangent), dot(v, frame.normal));
}

inline vec3 to_world(Frame frame, vec3 v) { return frame.tangent * v.x + frame.bitangent * v.y + frame.normal * v.z; }

}  // namespace target_core::kernels
