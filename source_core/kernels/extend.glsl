// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of target_core/kernels/extend.h.
#ifndef EXTEND_GLSL
#define EXTEND_GLSL

#include "coincident.glsl"
#include "sky.glsl"

void shade_sky(Uint path, vec3 direction, Throughput throughput, Mask where) {
    SkyLookup sky = look_up_sky(direction);
    add_radiance(path, throughput.weight * sky.radiance * found_by_chance(throughput, sky.pdf), where);
}

// Finds what the path's current ray meets first: a surface, to be shaded, or the sky, which ends the path here, so
// that shading has surfaces only in all its lanes.
void extend_path(Uint job) {
    Uint path = load_extension_job(job);
    Rows rows = rows_from(path);
    PathRay path_ray = load_path_ray(rows);
    Hit hit = trace_closest(path_ray.ray, path);
    if (has_feature(FEATURE_COINCIDENT)) {
        hit = lowest_in_place(path_ray.ray, hit, path);
    }
    Mask missed = hit.instance == NONE;
    push_surface_job(uvec4(path, hit.instance, hit.triangle, 0u), !missed);
    if (any_lane(missed)) {
        shade_sky(path, path_ray.ray.direction, load_throughput(rows), missed);
    }
}

#endif
