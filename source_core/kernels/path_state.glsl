// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of target_core/kernels/path_state.h.
#ifndef PATH_STATE_GLSL
#define PATH_STATE_GLSL

#include "buffers.glsl"
#include "math.glsl"

struct Ray {
    vec3 origin;
    vec3 direction;  // unit length
};

// What trace_closest finds. `triangle` is trace's own handle; u and v, as intersect_triangle has them, are as exact as
// the walk is.
struct Hit {
    Uint instance;  // NONE: nothing
    Uint triangle;
    Float u;
    Float v;
};

// A ray with its cone (Akenine-Moller et al. 2021): width at the origin and growth per unit length.
struct PathRay {
    Ray ray;
    Float cone_width;
    Float cone_spread;
};

PathRay load_path_ray(Rows path) {
    vec4 origin = load_path_origin(path);
    vec4 direction = load_path_direction(path);
    PathRay path_ray;
    path_ray.ray.origin = vec3(origin);
    path_ray.ray.direction = vec3(direction);
    path_ray.cone_width = origin.w;
    path_ray.cone_spread = direction.w;
    return path_ray;
}

// What a path carries from vertex to vertex.
struct Throughput {
    vec3 weight;  // product of BSDF * cosine / pdf
    Float pdf;    // per solid angle, of the last direction; 0: from the eye or a delta lobe
};

Throughput load_throughput(Rows path) {
    vec4 row = load_path_throughput(path);
    Throughput throughput;
    throughput.weight = vec3(row);
    throughput.pdf = row.w;
    return throughput;
}

void store_path(Uint path, PathRay path_ray, Throughput throughput, Mask where) {
    store_path_rows(path, vec4(path_ray.ray.origin, path_ray.cone_width),
                    vec4(path_ray.ray.direction, path_ray.cone_spread), vec4(throughput.weight, throughput.pdf), where);
}

// What a path of so many segments brings from a light to the eye, held to the limit where it is indirect light.
vec3 limited(vec3 contribution, uint segments) {
    vec3 result = contribution;
    if (settings.indirect_limit > 0.0f && segments >= 3u) {
        Float largest = max(max_component(contribution), SMALLEST);
        result = contribution * min(settings.indirect_limit / largest, 1.0f);
    }
    return result;
}

void add_radiance(Uint path, vec3 radiance, Mask where) {
    vec4 sum = load_path_radiance(rows_from(path));
    store_path_radiance(path, vec4(vec3(sum) + limited(radiance, pass.segment), sum.w), where);
}

// The solid that a path's ray goes through stands beside its radiance: 0 for none, else 1 more than its material.
Uint load_medium(Rows path) { return Uint(load_path_radiance(path).w); }

void store_medium(Uint path, Uint medium, Mask where) {
    vec4 row = load_path_radiance(rows_from(path));
    store_path_radiance(path, vec4(vec3(row), Float(medium)), where);
}

// Balance of two strategies by the power heuristic, Veach 1997; `pdf` > 0 is the one in use.
Float power_heuristic(Float pdf, Float other) {
    Float ratio = other / max(pdf, SMALLEST);
    return 1.0f / (1.0f + ratio * ratio);
}

// Weight of radiance that the BSDF's sampling found, where next event estimation could have found it with
// density `light_pdf`.
Float found_by_chance(Throughput throughput, Float light_pdf) {
    Mask competes = throughput.pdf > 0.0f && settings.next_event_estimation != 0u;
    return select(competes, power_heuristic(throughput.pdf, light_pdf), Float(1.0f));
}

#endif
