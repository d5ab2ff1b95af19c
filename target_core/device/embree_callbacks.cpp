// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/device/embree_callbacks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "target_core/device/float_mode.h"
#include "target_core/kernels/trace.h"

namespace target_core {

using namespace kernels;

namespace {

const TraceContext& context_of(RTCIntersectContext* context) { return *reinterpret_cast<const TraceContext*>(context); }

Ray ray_of(const TraceContext& context, uint lane) {
    return {vec3(context.origin.x[lane], context.origin.y[lane], context.origin.z[lane]),
            vec3(context.direction.x[lane], context.direction.y[lane], context.direction.z[lane])};
}

// Few rays meet a triangle that may let them through: their keys are computed here rather than for all rays.
uint key_of(const TraceContext& context, uint lane) { return ray_key(context.path[lane], context.kind); }

struct Candidate {
    TriangleTest test;
    bool met;  // hit, and not let through by its alpha
};

Candidate test_candidate(const TraceContext& context, uint lane, uint instance, uint primitive) {
    TriangleVertices triangle = fetch_triangle(instance, primitive);
    Candidate candidate;
    Ray ray = ray_of(context, lane);
    candidate.test = intersect_triangle(ray.origin, ray.direction, triangle.v0, triangle.v1, triangle.v2);
    candidate.met = candidate.test.hit;
    const InstanceGeometry& geometry = bound.geometry[instance];
    if (candidate.met && geometry.lets_rays_pass) {
        float opacity = bound.opacities[geometry.triangles[primitive].w];
        candidate.met =
            meets_surface(opacity, key_of(context, lane), instance, primitive, candidate.test.u, candidate.test.v);
    }
    return candidate;
}

// As in the source core's trace.glsl: room for the rounding of rays that come from far.
constexpr float PAD_SCALE = 4.76837158203125e-7f;

// Room for rounding in the triangle test, in proportion to the coordinates.
float pad(float low, float high) { return 1.0e-5f * std::max(std::fabs(low), std::fabs(high)) + 1.0e-30f; }

PackedVertex world_vertex(const InstanceGeometry& geometry, uint index) {
    PackedVertex p = geometry.positions[index];
    if (geometry.baked) {
        return p;
    }
    vec3 w = transform_point(geometry.rows[0], geometry.rows[1], geometry.rows[2], vec3(p.x, p.y, p.z));
    return {w.x, w.y, w.z};
}

RTCBounds box_of(const InstanceGeometry& geometry, uint primitive) {
    uvec4 corners = geometry.triangles[primitive];
    PackedVertex a = world_vertex(geometry, corners.x);
    PackedVertex b = world_vertex(geometry, corners.y);
    PackedVertex c = world_vertex(geometry, corners.z);
    RTCBounds box{};
    box.lower_x = std::min({a.x, b.x, c.x});
    box.lower_y = std::min({a.y, b.y, c.y});
    box.lower_z = std::min({a.z, b.z, c.z});
    box.upper_x = std::max({a.x, b.x, c.x});
    box.upper_y = std::max({a.y, b.y, c.y});
    box.upper_z = std::max({a.z, b.z, c.z});
    float margin = std::max({pad(box.lower_x, box.upper_x), pad(box.lower_y, box.upper_y),
                             pad(box.lower_z, box.upper_z), PAD_SCALE * geometry.reach});
    box.lower_x -= margin;
    box.lower_y -= margin;
    box.lower_z -= margin;
    box.upper_x += margin;
    box.upper_y += margin;
    box.upper_z += margin;
    return box;
}

}  // namespace

void filter_by_alpha(const RTCFilterFunctionNArguments* arguments) {
    // Nothing is bound while the limit is measured: that traces Embree alone.
    if (!bound.geometry) {
        return;
    }
    KeepDenormals keep;
    const TraceContext& context = context_of(arguments->context);
    uint count = arguments->N;
    for (uint i = 0; i < count; ++i) {
        if (arguments->valid[i] != -1) {
            continue;
        }
        uint placed = RTCHitN_instID(arguments->hit, count, i, 0);
        uint instance = placed != RTC_INVALID_GEOMETRY_ID ? placed : RTCHitN_geomID(arguments->hit, count, i);
        uint primitive = RTCHitN_primID(arguments->hit, count, i);
        uint lane = RTCRayN_id(arguments->ray, count, i);
        Ray ray = ray_of(context, lane);
        TriangleVertices triangle = fetch_triangle(instance, primitive);
        TriangleTest test = intersect_triangle(ray.origin, ray.direction, triangle.v0, triangle.v1, triangle.v2);
        float opacity = bound.opacities[bound.geometry[instance].triangles[primitive].w];
        if (!meets_surface(opacity, key_of(context, lane), instance, primitive, test.u, test.v)) {
            arguments->valid[i] = 0;
        }
    }
}

void bound_triangle(const RTCBoundsFunctionArguments* arguments) {
    *arguments->bounds_o = box_of(*static_cast<const InstanceGeometry*>(arguments->geometryUserPtr), arguments->primID);
}

void intersect_exactly(const RTCIntersectFunctionNArguments* arguments) {
    if (!arguments->valid[0]) {
        return;
    }
    auto* best = reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    uint instance = arguments->geomID;
    uint primitive = arguments->primID;
    const TraceContext& context = context_of(arguments->context);
    Candidate candidate = test_candidate(context, 0, instance, primitive);
    bool closer = candidate.test.t < best->ray.tfar;
    bool tied = candidate.test.t == best->ray.tfar && best->hit.geomID != RTC_INVALID_GEOMETRY_ID &&
                (instance < best->hit.geomID || (instance == best->hit.geomID && primitive < best->hit.primID));
    if (candidate.met && (closer || tied)) {
        best->ray.tfar = candidate.test.t;
        best->hit.geomID = instance;
        best->hit.primID = primitive;
        best->hit.u = candidate.test.u;
        best->hit.v = candidate.test.v;
        best->hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
}

void occlude_exactly(const RTCOccludedFunctionNArguments* arguments) {
    if (!arguments->valid[0]) {
        return;
    }
    auto* ray = reinterpret_cast<RTCRay*>(arguments->ray);
    Candidate candidate = test_candidate(context_of(arguments->context), 0, arguments->geomID, arguments->primID);
    if (candidate.met && candidate.test.t < ray->tfar) {
        ray->tfar = -std::numeric_limits<float>::infinity();
    }
}

}  // namespace target_core
