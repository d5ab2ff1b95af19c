// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of target_core/kernels/extend.h.
#ifndef EXTEND_GLSL
#define EXTEND_GLSL

#include "alpha.glsl"
#include "trace.glsl"

// Finds what the path's current ray meets first.
void extend_path(Uint job) {
    Uint path = load_extension_job(job);
    Uint stream = pixel_seed(path + pass.first_pixel, settings.seed);
    PathRay path_ray = load_path_ray(path);
    Hit hit = trace_closest(path_ray.ray, ray_key(stream, pass.sample_index, pass.segment, RAY_EXTENSION));
    store_hit(path, hit, true);
}

#endif
