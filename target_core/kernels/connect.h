// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/connect.glsl.
#pragma once

#include "target_core/kernels/trace.h"

namespace target_core::kernels {

// Traces one shadow ray and adds what it carries to its path if nothing is in the way.
inline void connect_shadow_ray(Uint job) {
    vec4 origin = load_shadow_origin(job);
    vec4 direction = load_shadow_direction(job);
    Uint path = floatBitsToUint(direction.w);
    Ray ray;
    ray.origin = vec3(origin);
    ray.direction = vec3(direction);
    Mask blocked = trace_any(ray, origin.w, path);
    vec4 radiance = load_path_radiance(rows_from(path)) + load_shadow_contribution(job);
    store_path_radiance(path, radiance, !blocked);
}

}  // namespace target_core::kernels
