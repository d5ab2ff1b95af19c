// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/device/ray_log.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>

#include "target_core/device/bindings.h"
#include "target_core/device/float_mode.h"
#include "target_core/device/parallel.h"
#include "target_core/kernels/trace.h"

namespace target_core {

void RayLog::record_extension_rays(const Tile& tile, bool primary) {
    Rays& rays = rays_.local();
    std::vector<LoggedRay>& kind = primary ? rays.primary : rays.extension;
    for (uint job = 0; job < tile.current.count; ++job) {
        uint path = tile.current.paths[job];
        kind.push_back({{kernels::vec3(tile.origin[path]), kernels::vec3(tile.direction[path])},
                        std::numeric_limits<float>::infinity()});
    }
}

void RayLog::record_shadow_rays(const Tile& tile) {
    std::vector<LoggedRay>& kind = rays_.local().shadow;
    for (uint job = 0; job < tile.shadow_count; ++job) {
        const vec4& origin = tile.shadow_origin[job];
        kind.push_back({{kernels::vec3(origin), kernels::vec3(tile.shadow_direction[job])}, origin.w});
    }
}

uint64_t RayLog::count() const {
    uint64_t count = 0;
    for (const Rays& rays : rays_) {
        count += rays.primary.size() + rays.extension.size() + rays.shadow.size();
    }
    return count;
}

RTCRayHit RayLog::embree_ray_hit(const LoggedRay& logged) {
    RTCRayHit hit{};
    hit.ray = kernels::embree_ray(logged.ray, logged.t_max);
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return hit;
}

RTCIntersectContext RayLog::context_for(Kind kind) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    // Not for shadow rays: Embree 3.13.5 (AVX-512) never returned from one coherent packet of the built-in scene.
    if (kind == Kind::primary) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

void RayLog::trace_single(RTCScene scene, const LoggedRay* rays, size_t count, Kind kind) {
    RTCIntersectContext context = context_for(kind);
    for (size_t i = 0; i < count; ++i) {
        if (kind == Kind::shadow) {
            RTCRay ray = kernels::embree_ray(rays[i].ray, rays[i].t_max);
            rtcOccluded1(scene, &context, &ray);
        } else {
            RTCRayHit hit = embree_ray_hit(rays[i]);
            rtcIntersect1(scene, &context, &hit);
        }
    }
}

void RayLog::trace_stream(RTCScene scene, const LoggedRay* rays, size_t count, Kind kind) {
    RTCIntersectContext context = context_for(kind);
    if (kind == Kind::shadow) {
        std::array<RTCRay, CHUNK> stream;
        std::transform(rays, rays + count, stream.begin(),
                       [](const LoggedRay& logged) { return kernels::embree_ray(logged.ray, logged.t_max); });
        rtcOccluded1M(scene, &context, stream.data(), static_cast<unsigned>(count), sizeof(RTCRay));
    } else {
        std::array<RTCRayHit, CHUNK> stream;
        std::transform(rays, rays + count, stream.begin(), embree_ray_hit);
        rtcIntersect1M(scene, &context, stream.data(), static_cast<unsigned>(count), sizeof(RTCRayHit));
    }
}

namespace {

// The packet calls of Embree under one name.
struct Packet8 {
    static constexpr size_t WIDTH = 8;
    using RayHit = RTCRayHit8;
    using Ray = RTCRay8;
    static void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context, RayHit* rays) {
        rtcIntersect8(valid, scene, context, rays);
    }
    static void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, Ray* rays) {
        rtcOccluded8(valid, scene, context, rays);
    }
};

struct Packet16 {
    static constexpr size_t WIDTH = 16;
    using RayHit = RTCRayHit16;
    using Ray = RTCRay16;
    static void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context, RayHit* rays) {
        rtcIntersect16(valid, scene, context, rays);
    }
    static void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, Ray* rays) {
        rtcOccluded16(valid, scene, context, rays);
    }
};

}  // namespace

template <class Packet>
void RayLog::trace_packets(RTCScene scene, const LoggedRay* rays, size_t count, Kind kind) {
    bool shadow = kind == Kind::shadow;
    RTCIntersectContext context = context_for(kind);
    for (size_t first = 0; first < count; first += Packet::WIDTH) {
        alignas(64) int valid[Packet::WIDTH] = {};
        alignas(64) typename Packet::RayHit packet{};
        for (size_t lane = 0; lane < Packet::WIDTH && first + lane < count; ++lane) {
            const auto& [ray, t_max] = rays[first + lane];
            valid[lane] = -1;
            packet.ray.org_x[lane] = ray.origin.x;
            packet.ray.org_y[lane] = ray.origin.y;
            packet.ray.org_z[lane] = ray.origin.z;
            packet.ray.dir_x[lane] = ray.direction.x;
            packet.ray.dir_y[lane] = ray.direction.y;
            packet.ray.dir_z[lane] = ray.direction.z;
            packet.ray.tfar[lane] = t_max;
            packet.ray.mask[lane] = ~0u;
            packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
            packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        }
        if (shadow) {
            Packet::occluded(valid, scene, &context, &packet.ray);
        } else {
            Packet::intersect(valid, scene, &context, &packet);
        }
    }
}

template <class Trace>
double RayLog::time_of(const std::vector<LoggedRay> Rays::*kind, const Trace& trace) const {
    auto start = std::chrono::steady_clock::now();
    for (const Rays& thread : rays_) {
        const std::vector<LoggedRay>& rays = thread.*kind;
        for_each_tile(static_cast<uint>((rays.size() + CHUNK - 1) / CHUNK), [&](uint chunk) {
            reach_thread_memory();
            bound = {};
            FlushDenormals flush;  // as Embree likes it best
            size_t first = chunk * CHUNK;
            trace(rays.data() + first, std::min(CHUNK, rays.size() - first));
        });
    }
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double RayLog::replay(RTCDevice device, RTCScene scene) const {
    bool wide = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
    auto fastest = [&](const std::vector<LoggedRay> Rays::*rays, Kind kind) {
        double best = time_of(rays, [&](const LoggedRay* r, size_t n) { trace_packets<Packet8>(scene, r, n, kind); });
        auto also = [&](auto&& trace) {
            best = std::min(best, time_of(rays, [&](const LoggedRay* r, size_t n) { trace(scene, r, n, kind); }));
        };
        if (wide) also(trace_packets<Packet16>);
        also(trace_single);
        also(trace_stream);
        return best;
    };
    return fastest(&Rays::primary, Kind::primary) + fastest(&Rays::extension, Kind::extension) +
           fastest(&Rays::shadow, Kind::shadow);
}

}  // namespace target_core
