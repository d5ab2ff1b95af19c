// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>
#include <tbb/enumerable_thread_specific.h>

#include <vector>

#include "target_core/device/tile.h"
#include "target_core/kernels/path_state.h"

namespace target_core {

/// The rays of a frame, kept by kind, so that Embree alone can trace the very same ones: the limit of this core.
class RayLog {
public:
    void record_extension_rays(const Tile& tile, bool primary);
    void record_shadow_rays(const Tile& tile);

    uint64_t count() const;

    /// Traces all rays again and does nothing else, on the current task arena: each kind by packets of 8, by packets of
    /// 16 where the CPU has them, one by one and as streams. Wall time of the fastest call for each kind, in
    /// milliseconds.
    double replay(RTCDevice device, RTCScene scene) const;

private:
    enum class Kind : uint8_t { primary, extension, shadow };
    struct LoggedRay {
        kernels::Ray ray;
        float t_max;
    };
    struct Rays {
        std::vector<LoggedRay> primary;
        std::vector<LoggedRay> extension;
        std::vector<LoggedRay> shadow;
    };
    static constexpr size_t CHUNK = 1024;  // rays that a thread takes at a time, and of a stream
    static RTCRayHit embree_ray_hit(const LoggedRay& logged);
    static RTCIntersectContext context_for(Kind kind);
    static void trace_single(RTCScene scene, const LoggedRay* rays, size_t count, Kind kind);
    static void trace_stream(RTCScene scene, const LoggedRay* rays, size_t count, Kind kind);
    template <class Packet>
    static void trace_packets(RTCScene scene, const LoggedRay* rays, size_t count, Kind kind);
    /// Wall time of trace(rays, count) over all rays of one kind, in chunks, in milliseconds.
    template <class Trace>
    double time_of(const std::vector<LoggedRay> Rays::*kind, const Trace& trace) const;

    tbb::enumerable_thread_specific<Rays> rays_;
};

}  // namespace target_core
