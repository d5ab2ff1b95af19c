// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/path_state.glsl.
#pragma once

#include "target_core/kernels/buffers.h"
#include "target_core/kernels/math.h"

namespace target_core::kernels {

struct Ray {
    vec3 origin;
    vec3 direction;  // unit length
};

// What trace_closest finds. `triangle` is trace's own handle; u and v belong to vertices 1 and 2.
struct Hit {
    Uint instance;  // NONE: nothing
    Uint triangle;
    Float t;
    Float u;
    Float v;
};

// A ray with its cone (Akenine-Moller et al. 2021): width at the origin and growth per unit length.
struct PathRay {
    Ray ray;
    Float cone_width;
    Float cone_spread;
};

inline PathRay load_path_ray(Uint path) {
    vec4 origin = load_path_origin(path);
    vec4 direction = load_path_direction(path);
    PathRay path_ray;
    path_ray.ray.origin = vec3(origin);
    path_ray.ray.direction = vec3(direction);
    path_ray.cone_width = origin.w;
    path_ray.cone_spread = direction.w;
    return path_ray;
}

inline void store_path_ray(Uint path, PathRay path_ray, Mask where) {
    store_path_origin(path, vec4(path_ray.ray.origin, path_ray.cone_width), where);
    store_path_direction(path, vec4(path_ray.ray.direction, path_ray.cone_spread), where);
}

inline Hit load_hit(Uint path) {
    uvec4 row = load_path_hit(path);
    Hit hit;
    hit.instance = row.x;
    hit.triangle = row.y;
    hit.t = 0.0f;
    hit.u = uintBitsToFloat(row.z);
    hit.v = uintBitsToFloat(row.w);
    return hit;
}

inline void store_hit(Uint path, Hit hit, Mask where) {
    store_path_hit(path, uvec4(hit.instance, hit.triangle, floatBitsToUint(hit.u), floatBitsToUint(hit.v)), where);
}

}  // namespace target_core::kernels
