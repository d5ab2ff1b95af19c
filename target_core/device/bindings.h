// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include "target_core/device/instance_geometry.h"
#include "target_core/device/tile.h"
#include "target_core/kernels/layout.h"

namespace target_core {

/// What the source core binds to its descriptor set, bound here to the thread that works on a tile: tables of
/// layout.h, the tile, the sums of all samples and Embree's scene. A kernel reaches these through buffers.h and
/// trace.h only.
struct Bindings {
    const uvec4* mesh_triangles = nullptr;
    const vec4* vertices = nullptr;
    const vec4* instances = nullptr;
    const vec4* materials = nullptr;
    const vec4* texture_slots = nullptr;
    const uvec4* textures = nullptr;
    const uint* texels = nullptr;
    const vec4* lights = nullptr;
    const vec4* light_table = nullptr;
    const vec4* sky_texels = nullptr;
    const vec4* sky_table = nullptr;
    const vec4* lobe_energy = nullptr;
    const uvec4* coincident = nullptr;
    const float* opacities = nullptr;  // per material; negative: needs texture or vertex colour
    const InstanceGeometry* geometry = nullptr;
    RTCScene scene = nullptr;
    vec4* accumulator = nullptr;
    float* guides = nullptr;  // in blocks (lanes.h); these three: only for a filter
    vec4* filter_picture = nullptr;
    float* planes = nullptr;        // where the first one's first pixel is; before and behind each are zeros
    size_t plane_stride = 0;        // from one plane to the next
    const vec4* motions = nullptr;  // and these: only for one with a history
    float* history = nullptr;
    const float* history_before = nullptr;
    Tile* tile = nullptr;
};

/// What most scenes lack: wide kernels are compiled once with these and, for shading, once without.
constexpr uint LOBE_FEATURES = FEATURE_SHEEN | FEATURE_COAT | FEATURE_FILM | FEATURE_LOBE_TEXTURES | FEATURE_VOLUME |
                               FEATURE_ANISOTROPY | FEATURE_DEEP_TEXELS | FEATURE_MORE_UV;

/// Bound per thread for the duration of a tile, as descriptors are for a dispatch.
inline constinit thread_local Bindings bound{};
inline constinit thread_local Settings settings{};
inline constinit thread_local Pass pass{};

/// To be called before a thread's first use of these. In a module the system makes a thread's copy of them when it
/// first asks for one, and glibc before 2.40 takes vector registers for that which the compiler believes kept (BZ
/// 31372).
void reach_thread_memory();

}  // namespace target_core
