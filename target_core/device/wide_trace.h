// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// trace.h for LANES rays at a time: Embree's packets, whose rays lie in memory as the lanes do.
#pragma once

#include <limits>
#include <type_traits>

#include "target_core/device/float_mode.h"
#include "target_core/device/trace_context.h"
#include "target_core/kernels/alpha.h"

namespace target_core::kernels {

inline TriangleVertices fetch_triangle(Uint instance, Uint triangle) {
    const float* at[3][LANES];
    LaneWords instances(instance);
    LaneWords triangles(triangle);
    uint baked = 0;
    for (uint i = 0; i < LANES; ++i) {
        const InstanceGeometry& geometry = bound.geometry[instances[i]];
        baked |= static_cast<uint>(geometry.baked) << i;
        const target_core::uvec4& corners = geometry.triangles[triangles[i]];
        at[0][i] = &geometry.positions[corners.x].x;
        at[1][i] = &geometry.positions[corners.y].x;
        at[2][i] = &geometry.positions[corners.z].x;
    }
    // Positions are packed to three floats; load_rows reads a fourth, for which the meshes leave room at their end.
    auto load = [&](const float* const* rows) {
        FloatLanes x, y, z, beyond;
        load_rows([&](uint lane) { return rows[lane]; }, x, y, z, beyond);
        return vec3(Float(x), Float(y), Float(z));
    };
    TriangleVertices vertices = {load(at[0]), load(at[1]), load(at[2]), triangle};
    Mask stays = Mask::of(mask_of_bits(baked));
    if (any_lane(!stays)) {
        auto row = [&](int k) {
            vec4 lanes;
            load_rows([&](uint lane) { return &bound.geometry[instances[lane]].rows[k].x; }, lanes.x.v, lanes.y.v,
                      lanes.z.v, lanes.w.v);
            return lanes;
        };
        vec4 row0 = row(0), row1 = row(1), row2 = row(2);
        vertices.v0 = select(stays, vertices.v0, transform_point(row0, row1, row2, vertices.v0));
        vertices.v1 = select(stays, vertices.v1, transform_point(row0, row1, row2, vertices.v1));
        vertices.v2 = select(stays, vertices.v2, transform_point(row0, row1, row2, vertices.v2));
    }
    return vertices;
}

// Embree's packets of this many lanes.
using RayPacket = std::conditional_t<LANES == 16, RTCRay16, RTCRay8>;
using HitPacket = std::conditional_t<LANES == 16, RTCRayHit16, RTCRayHit8>;

inline void trace_packet(const int* valid, RTCIntersectContext* context, RTCRayHit8* rays) {
    rtcIntersect8(valid, bound.scene, context, rays);
}
inline void trace_packet(const int* valid, RTCIntersectContext* context, RTCRayHit16* rays) {
    rtcIntersect16(valid, bound.scene, context, rays);
}
inline void trace_packet(const int* valid, RTCIntersectContext* context, RTCRay8* rays) {
    rtcOccluded8(valid, bound.scene, context, rays);
}
inline void trace_packet(const int* valid, RTCIntersectContext* context, RTCRay16* rays) {
    rtcOccluded16(valid, bound.scene, context, rays);
}

template <class Word, size_t WIDTH, class Lanes>
inline void put_lanes(Word (&row)[WIDTH], const Lanes& lanes) {
    static_assert(sizeof(row) == sizeof(lanes));
    __builtin_memcpy(row, &lanes, sizeof(row));
}
template <class Word, size_t WIDTH, class Lanes>
inline void take_lanes(const Word (&row)[WIDTH], Lanes& lanes) {
    static_assert(sizeof(row) == sizeof(lanes));
    __builtin_memcpy(&lanes, row, sizeof(row));
}

template <class Packet>
inline void fill_packet(Packet& packet, const Ray& ray, const Float& t_max) {
    put_lanes(packet.org_x, ray.origin.x.v);
    put_lanes(packet.org_y, ray.origin.y.v);
    put_lanes(packet.org_z, ray.origin.z.v);
    put_lanes(packet.tnear, FloatLanes{});
    put_lanes(packet.dir_x, ray.direction.x.v);
    put_lanes(packet.dir_y, ray.direction.y.v);
    put_lanes(packet.dir_z, ray.direction.z.v);
    put_lanes(packet.time, FloatLanes{});
    put_lanes(packet.tfar, t_max.v);
    put_lanes(packet.mask, ~UintLanes{});
    put_lanes(packet.id, lane_numbers().v);
    put_lanes(packet.flags, UintLanes{});
}

inline Hit trace_closest(const Ray& ray, const Uint& path) {
    TraceContext context(ray, path, RAY_EXTENSION);
    HitPacket packet;
    fill_packet(packet.ray, ray, std::numeric_limits<float>::infinity());
    put_lanes(packet.hit.geomID, ~UintLanes{});
    put_lanes(packet.hit.instID[0], ~UintLanes{});
    put_lanes(packet.hit.u, FloatLanes{});
    put_lanes(packet.hit.v, FloatLanes{});
    alignas(64) IntLanes valid = mask_words(mask_of_bits(active_lanes));
    const int* lanes = reinterpret_cast<const int*>(&valid);
    if (pass.segment == 1u) {
        // Camera rays share an origin: Embree walks their packets as one, slower over denormals.
        context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        FlushDenormals flush;
        trace_packet(lanes, &context.embree, &packet);
    } else {
        trace_packet(lanes, &context.embree, &packet);
    }
    static_assert(RTC_INVALID_GEOMETRY_ID == NONE);
    Uint geometry;
    Uint placed;
    Hit hit;
    take_lanes(packet.hit.geomID, geometry.v);
    take_lanes(packet.hit.instID[0], placed.v);
    take_lanes(packet.hit.primID, hit.triangle.v);
    take_lanes(packet.hit.u, hit.u.v);
    take_lanes(packet.hit.v, hit.v.v);
    hit.instance = select(placed != RTC_INVALID_GEOMETRY_ID, placed, geometry);
    return hit;
}

inline Mask trace_any(const Ray& ray, const Float& t_max, const Uint& path) {
    TraceContext context(ray, path, RAY_SHADOW);
    RayPacket packet;
    fill_packet(packet, ray, t_max);
    alignas(64) IntLanes valid = mask_words(mask_of_bits(active_lanes));
    trace_packet(reinterpret_cast<const int*>(&valid), &context.embree, &packet);
    Float end;
    take_lanes(packet.tfar, end.v);
    return end < 0.0f;
}

}  // namespace target_core::kernels
