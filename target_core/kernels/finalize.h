// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/finalize.glsl.
#pragma once

#include "target_core/kernels/path_state.h"

namespace target_core::kernels {

// Adds the finished path to its pixel's sum, in order of samples, and writes the mean.
inline void finalize_pixel(Uint job) {
    Uint pixel = job + pass.first_pixel;
    vec3 radiance = vec3(load_path_radiance(rows_from(job)));
    vec3 sum = radiance;
    if (pass.first_in_sum == 0u) {
        sum = vec3(load_accumulator(pixel)) + radiance;
    }
    store_accumulator(pixel, vec4(sum, 1.0f));
    store_target(pixel, vec4(sum * pass.sample_scale, 1.0f));
}

}  // namespace target_core::kernels
