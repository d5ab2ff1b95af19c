// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of target_core/kernels/generate.h.
#ifndef GENERATE_GLSL
#define GENERATE_GLSL

#include "path_state.glsl"
#include "random.glsl"

// Starts one path: a ray from the eye through a random point of its pixel (box filter). With a thin lens it starts from
// a random point of that, for the same point of the screen, which stands where pictures are sharp. Orthographic rays
// start beside the eye and all go the same way.
void generate_path(Uint job) {
    Uint pixel = job + pass.first_pixel;
    Uint row = pixel / settings.width;
    Uint column = pixel - row * settings.width;
    Uint stream = pixel_seed(pixel, settings.seed);
    vec2 jitter = random_pair(stream, pass.sample_index, PAIR_PIXEL);
    Float x = (Float(column) + jitter.x) / float(settings.width);
    Float y = (Float(row) + jitter.y) / float(settings.height);
    vec3 through = (vec3(settings.screen) + vec3(settings.screen_right) * x) + vec3(settings.screen_down) * y;
    vec3 on_lens = vec3(0.0f);
    if (settings.lens_right.w > 0.0f) {
        vec2 u = random_pair(stream, pass.sample_index, PAIR_LENS);
        vec2 around = cos_sin_turns(u.y) * sqrt(u.x);
        on_lens = vec3(settings.lens_right) * around.x + vec3(settings.lens_down) * around.y;
        through = through - on_lens;
    }
    if (settings.lens_down.w > 0.0f) {
        on_lens = vec3(settings.screen_right) * (x - 0.5f) + vec3(settings.screen_down) * (y - 0.5f);
        through = through - on_lens;
    }
    PathRay path_ray;
    path_ray.ray.origin = vec3(settings.eye) + on_lens;
    path_ray.ray.direction = normalized(through);
    path_ray.cone_width = Float(settings.lens_down.w);
    path_ray.cone_spread = settings.eye.w;
    Throughput throughput;
    throughput.weight = vec3(1.0f);
    throughput.pdf = 0.0f;
    store_path(job, path_ray, throughput, true);
    store_path_radiance(job, vec4(0.0f), true);
    push_extension_ray(job, true);
}

#endif
