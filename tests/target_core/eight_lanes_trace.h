// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What shade needs of trace.h, for eight lanes: vertices lane by lane. Embree's side is not part of the proof.
#pragma once

#include "target_core/kernels/alpha.h"

namespace target_core::kernels {

inline TriangleVertices fetch_triangle(Uint instance, Uint triangle) {
    TriangleVertices vertices;
    auto set = [](vec3& wide, int lane, PackedVertex v) {
        wide.x.v[lane] = v.x;
        wide.y.v[lane] = v.y;
        wide.z.v[lane] = v.z;
    };
    for (int i = 0; i < LANES; ++i) {
        const InstanceGeometry& geometry = bound.geometry[instance.v[i]];
        target_core::uvec4 corners = geometry.triangles[triangle.v[i]];
        set(vertices.v0, i, geometry.positions[corners.x]);
        set(vertices.v1, i, geometry.positions[corners.y]);
        set(vertices.v2, i, geometry.positions[corners.z]);
    }
    vertices.primitive = triangle;
    return vertices;
}

}  // namespace target_core::kernels
