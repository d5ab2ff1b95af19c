// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <span>

#include "target_core/device/coincident.h"

namespace target_core {

/// Embree's callbacks. They run on the thread that traces and read what is bound to it.

/// Filter of native mode: lets a ray pass where meets_surface says so, at u and v of the shared triangle test.
void filter_by_alpha(const RTCFilterFunctionNArguments* arguments);

/// Exact mode: the padded box of one triangle in world space, and the shared triangle test with ties to the lower
/// (instance, primitive).
void bound_triangle(const RTCBoundsFunctionArguments* arguments);
void intersect_exactly(const RTCIntersectFunctionNArguments* arguments);
void occlude_exactly(const RTCOccludedFunctionNArguments* arguments);

/// The same in native mode, for as many rays as Embree brings, over the triangles that share a surface: the geometry's
/// user data are a SharedTriangles.
struct SharedTriangles {
    std::span<const InstanceGeometry> geometry;
    std::vector<SharedTriangle> triangles;
};
void bound_shared_triangle(const RTCBoundsFunctionArguments* arguments);
void intersect_shared_triangle(const RTCIntersectFunctionNArguments* arguments);
void occlude_shared_triangle(const RTCOccludedFunctionNArguments* arguments);

/// A vertex of an instance in world space.
PackedVertex world_vertex(const InstanceGeometry& geometry, uint index);

}  // namespace target_core
