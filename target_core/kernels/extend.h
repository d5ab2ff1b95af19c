// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/extend.glsl.
#pragma once

#include "target_core/kernels/alpha.h"
#include "target_core/kernels/trace.h"

namespace target_core::kernels {

// Finds what the path's current ray meets first.
inline void extend_path(Uint job) {
    Uint path = load_extension_job(job);
    Uint stream = pixel_seed(path + pass.first_pixel, settings.seed);
    PathRay path_ray = load_path_ray(path);
    Hit hit = trace_closest(path_ray.ray, ray_key(stream, pass.sample_index, pass.segment, RAY_EXTENSION));
    store_hit(path, hit, true);
}

}  // namespace target_core::kernels
