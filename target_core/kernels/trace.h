// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: rewritten; the original is source_core/kernels/trace.glsl. The contract of both: the closest triangle with
// t > 0, ties to the lower (instance, primitive); whether anything lies in (0, t_max); a hit's vertices in world space.
// Here the walk is Embree's; where on the triangle the hit lies is found by the shared triangle test in shading, so
// that all after the hit agrees.
#pragma once

#ifdef TARGET_CORE_LANES
#include TARGET_CORE_TRACE
#else

#include <limits>

#include "target_core/device/trace_context.h"
#include "target_core/kernels/alpha.h"

namespace target_core::kernels {

inline vec3 unpack_vertex(PackedVertex v) { return vec3(v.x, v.y, v.z); }

inline TriangleVertices fetch_triangle(Uint instance, Uint triangle) {
    const InstanceGeometry& geometry = bound.geometry[instance];
    uvec4 corners = geometry.triangles[triangle];
    TriangleVertices vertices;
    vertices.v0 = unpack_vertex(geometry.positions[corners.x]);
    vertices.v1 = unpack_vertex(geometry.positions[corners.y]);
    vertices.v2 = unpack_vertex(geometry.positions[corners.z]);
    vertices.primitive = triangle;
    if (!geometry.baked) {
        vertices.v0 = transform_point(geometry.rows[0], geometry.rows[1], geometry.rows[2], vertices.v0);
        vertices.v1 = transform_point(geometry.rows[0], geometry.rows[1], geometry.rows[2], vertices.v1);
        vertices.v2 = transform_point(geometry.rows[0], geometry.rows[1], geometry.rows[2], vertices.v2);
    }
    return vertices;
}

inline RTCRay embree_ray(Ray ray, float t_max) {
    RTCRay embree;
    embree.org_x = ray.origin.x;
    embree.org_y = ray.origin.y;
    embree.org_z = ray.origin.z;
    embree.tnear = 0.0f;
    embree.dir_x = ray.direction.x;
    embree.dir_y = ray.direction.y;
    embree.dir_z = ray.direction.z;
    embree.time = 0.0f;
    embree.tfar = t_max;
    embree.mask = ~0u;
    embree.id = 0;
    embree.flags = 0;
    return embree;
}

inline Hit trace_closest(Ray ray, Uint path) {
    TraceContext context(ray, path, RAY_EXTENSION);
    RTCRayHit found;
    found.ray = embree_ray(ray, std::numeric_limits<float>::infinity());
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(bound.scene, &context.embree, &found);
    Hit hit;
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        hit.instance = NONE;
        hit.triangle = 0u;
        hit.u = 0.0f;
        hit.v = 0.0f;
        return hit;
    }
    bool instanced = found.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    hit.instance = instanced ? found.hit.instID[0] : found.hit.geomID;
    hit.triangle = found.hit.primID;
    hit.u = found.hit.u;
    hit.v = found.hit.v;
    return hit;
}

inline Mask trace_any(Ray ray, Float t_max, Uint path) {
    TraceContext context(ray, path, RAY_SHADOW);
    RTCRay found = embree_ray(ray, t_max);
    rtcOccluded1(bound.scene, &context.embree, &found);
    return found.tfar < 0.0f;
}

}  // namespace target_core::kernels

#endif
