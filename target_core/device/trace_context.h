// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include "target_core/device/glsl.h"

namespace target_core {

/// What Embree's callbacks need to know of the rays at work: Embree hands them the address of its own context, which is
/// this object's first member. The rays are kept in world space because Embree shows callbacks of instanced meshes the
/// transformed ones, and the shared triangle test wants the originals. A ray is known by its id: its lane.
struct TraceContext {
    RTCIntersectContext embree;
    Vec3<const float*> origin;
    Vec3<const float*> direction;
    const uint* path;
    uint kind;  // of ray: RAY_EXTENSION or RAY_SHADOW

    /// Refers to `ray` and `paths` of any lane type, which must outlive the trace.
    template <class Ray, class Uint>
    TraceContext(const Ray& ray, const Uint& paths, uint kind_of_ray)
        : origin(first_lanes(ray.origin)),
          direction(first_lanes(ray.direction)),
          path(reinterpret_cast<const uint*>(&paths)),
          kind(kind_of_ray) {
        rtcInitIntersectContext(&embree);
    }

private:
    template <class F>
    static Vec3<const float*> first_lanes(const Vec3<F>& v) {
        return {reinterpret_cast<const float*>(&v.x), reinterpret_cast<const float*>(&v.y),
                reinterpret_cast<const float*>(&v.z)};
    }
};

}  // namespace target_core
