// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "target_core/device/glsl.h"

namespace target_core {

/// A vertex as Embree reads it: three floats without padding.
struct PackedVertex {
    float x, y, z;
};

/// Where an instance's triangles are. `positions` are in world space if `baked` (the mesh has this instance only),
/// else in mesh space under `rows`. Triangle indices count from positions[0].
struct InstanceGeometry {
    const PackedVertex* positions = nullptr;
    const uvec4* triangles = nullptr;
    uint vertex_count = 0;
    uint triangle_count = 0;  // 0: hidden
    uint mesh = 0;
    uint bin = 0;        // by which order_surfaces sorts
    float reach = 0.0f;  // the largest coordinate of rays' origins, where boxes are to be padded for it
    bool baked = true;
    bool lets_rays_pass = false;  // some material is not opaque
    bool deforms = false;         // the mesh has changed its shape before: its tree is fitted, not built, when it does
    vec4 rows[3];
};

}  // namespace target_core
