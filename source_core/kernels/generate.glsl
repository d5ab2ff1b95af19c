// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of target_core/kernels/generate.h.
#ifndef GENERATE_GLSL
#define GENERATE_GLSL

#include "path_state.glsl"
#include "random.glsl"

// Starts one path: a ray from the eye through a random point of its pixel (box filter).
void generate_path(Uint job) {
    Uint pixel = job + pass.first_pixel;
    Uint row = pixel / settings.width;
    Uint column = pixel - row * settings.width;
    vec2 jitter = random_pair(pixel_seed(pixel, settings.seed), pass.sample_index, PAIR_PIXEL);
    Float x = (Float(column) + jitter.x) / float(settings.width);
    Float y = (Float(row) + jitter.y) / float(settings.height);
    vec3 through = (vec3(settings.screen) + vec3(settings.screen_right) * x) + vec3(settings.screen_down) * y;
    PathRay path_ray;
    path_ray.ray.origin = vec3(settings.eye);
    path_ray.ray.direction = normalized(through);
    path_ray.cone_width = 0.0f;
    path_ray.cone_spread = settings.eye.w;
    Throughput throughput;
    throughput.weight = vec3(1.0f);
    throughput.pdf = 0.0f;
    store_path(job, path_ray, throughput, true);
    store_path_radiance(job, vec4(0.0f), true);
    push_extension_ray(job, true);
}

#endif
