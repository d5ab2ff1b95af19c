// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "target_core/kernels/path_state.h"

namespace target_core {

/// What Embree's callbacks need to know of the ray at work: Embree hands them the address of its own context, which
/// is this object's first member. The ray is kept in world space because Embree shows callbacks of instanced meshes
/// the transformed one, and the shared triangle test wants the original.
struct TraceContext {
    RTCIntersectContext embree;
    kernels::Ray ray;
    kernels::Uint key;

    TraceContext(kernels::Ray ray_in, kernels::Uint key_in) : ray(ray_in), key(key_in) {
        rtcInitIntersectContext(&embree);
    }
};

}  // namespace target_core
