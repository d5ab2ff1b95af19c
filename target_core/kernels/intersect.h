// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/intersect.glsl.
#pragma once

#include "target_core/kernels/math.h"

namespace target_core::kernels {

// World space from mesh space; the host bakes vertices with this same arithmetic.
inline vec3 transform_point(vec4 row0, vec4 row1, vec4 row2, vec3 p) {
    return vec3(((row0.x * p.x + row0.y * p.y) + row0.z * p.z) + row0.w,
                ((row1.x * p.x + row1.y * p.y) + row1.z * p.z) + row1.w,
                ((row2.x * p.x + row2.y * p.y) + row2.z * p.z) + row2.w);
}

inline vec3 transform_vector(vec4 row0, vec4 row1, vec4 row2, vec3 v) {
    return vec3((row0.x * v.x + row0.y * v.y) + row0.z * v.z, (row1.x * v.x + row1.y * v.y) + row1.z * v.z,
                (row2.x * v.x + row2.y * v.y) + row2.z * v.z);
}

// Normals go by the matrix of cofactors: the inverse transpose without the division, right for any scale but for
// the sign, which mirrored instances flip.
inline vec3 transform_normal(vec4 row0, vec4 row1, vec4 row2, vec3 n) {
    vec3 a = vec3(row0);
    vec3 b = vec3(row1);
    vec3 c = vec3(row2);
    return vec3(dot(cross(b, c), n), dot(cross(c, a), n), dot(cross(a, b), n));
}

struct TriangleTest {
    Mask hit;  // inside the triangle and in front of the origin
    Float t;
    Float u;
    Float v;
};

// The one formula by which both cores find t, u and v, whoever found the triangle; both sides count. Plucker
// coordinates seen from the origin (Davidovic et al. 2012): the two triangles at an edge compute its side with the
// same bits and opposite signs, so no ray slips between them. Sums times differences, (b + c) x (c - b) = 2 b x c,
// lose no digits on small triangles far away. A degenerate triangle is never hit.
inline TriangleTest intersect_triangle(vec3 origin, vec3 direction, vec3 v0, vec3 v1, vec3 v2) {
    vec3 a = v0 - origin;
    vec3 b = v1 - origin;
    vec3 c = v2 - origin;
    Float weight0 = dot(cross(b + c, c - b), direction);
    Float weight1 = dot(cross(c + a, a - c), direction);
    Float weight2 = dot(cross(a + b, b - a), direction);
    Float sum = (weight0 + weight1) + weight2;
    Float lowest = min(min(weight0, weight1), weight2);
    Float highest = max(max(weight0, weight1), weight2);
    vec3 normal = cross(v1 - v0, v2 - v0);
    Float approach = dot(normal, direction);
    Mask crosses = sum != 0.0f && approach != 0.0f;
    Float scale = 1.0f / select(crosses, sum, Float(1.0f));
    TriangleTest test;
    test.t = dot(normal, a) / select(crosses, approach, Float(1.0f));
    test.u = weight1 * scale;
    test.v = weight2 * scale;
    test.hit = crosses && (lowest >= 0.0f || highest <= 0.0f) && test.t > 0.0f;
    return test;
}

inline Float offset_component(Float p, Float n) {
    Int steps = Int(256.0f * n);
    Float moved = uintBitsToFloat(floatBitsToUint(p) + Uint(select(p < 0.0f, -steps, steps)));
    return select(abs(p) < 0.03125f, p + n * 1.52587890625e-5f, moved);
}

// Moves a point off its surface to the side that `normal` points to, by units in the last place: Wachter and
// Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection".
inline vec3 offset_point(vec3 p, vec3 normal) {
    return vec3(offset_component(p.x, normal.x), offset_component(p.y, normal.y), offset_component(p.z, normal.z));
}

}  // namespace target_core::kernels
