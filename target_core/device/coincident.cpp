// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/device/coincident.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "target_core/device/embree_callbacks.h"
#include "target_core/device/parallel.h"
#include "target_core/kernels/math.h"

namespace target_core {

namespace {

using kernels::vec3;

constexpr float kSharedDistance = 1e-5f;    // of the largest coordinate
constexpr float kLongEdge = 1e-2f;          // of that, too
constexpr float kSameDirection = 0.99999f;  // cosine
constexpr uint kTrianglesPerTask = 4096;

struct WorldTriangle {
    vec3 v0, edge1, edge2;

    WorldTriangle(const InstanceGeometry& geometry, uint primitive) {
        const uvec4 corners = geometry.triangles[primitive];
        const PackedVertex a = world_vertex(geometry, corners.x), b = world_vertex(geometry, corners.y),
                           c = world_vertex(geometry, corners.z);
        v0 = vec3(a.x, a.y, a.z);
        edge1 = vec3(b.x, b.y, b.z) - v0;
        edge2 = vec3(c.x, c.y, c.z) - v0;
    }
    vec3 normal() const { return kernels::normalized(cross(edge1, edge2)); }
    vec3 at(float u, float v) const { return (v0 + edge1 * u) + edge2 * v; }
    float reach() const { return std::sqrt(std::max(dot(edge1, edge1), dot(edge2, edge2))); }
};

// Marks of all triangles, by instance; threads set them in any order.
class Marks {
public:
    explicit Marks(std::span<const InstanceGeometry> geometry) {
        uint64_t count = 0;
        for (const InstanceGeometry& instance : geometry) {
            first_.push_back(count);
            count += instance.triangle_count;
        }
        marks_.assign(count, 0);
    }
    void set(uint instance, uint primitive) {
        std::atomic_ref(marks_[first_[instance] + primitive]).store(1, std::memory_order_relaxed);
    }
    bool has(uint instance, uint primitive) const { return marks_[first_[instance] + primitive] != 0; }

private:
    std::vector<uint64_t> first_;
    std::vector<uint8_t> marks_;
};

// A point of a triangle, around which others are looked for.
struct SurfaceProbe {
    std::span<const InstanceGeometry> geometry;
    Marks* marks;
    uint instance;
    uint primitive;
    float distance;
    vec3 normal;
    vec3 place;
};

// Embree brings what has a box that the point is in. The answer: whether it shall look less far from now on.
bool mark_what_is_shared(RTCPointQueryFunctionArguments* arguments) {
    const SurfaceProbe& probe = *static_cast<const SurfaceProbe*>(arguments->userPtr);
    const RTCPointQueryContext& context = *arguments->context;
    const uint instance = context.instStackSize > 0 ? context.instID[0] : arguments->geomID;
    const uint primitive = arguments->primID;
    if (instance == probe.instance && primitive == probe.primitive) return false;
    const WorldTriangle other(probe.geometry[instance], primitive);
    const vec3 way = probe.place - other.v0, area = cross(other.edge1, other.edge2);
    const float area_squared = std::max(dot(area, area), kernels::SMALLEST);
    const float u = dot(cross(way, other.edge2), area) / area_squared;
    const float v = dot(cross(other.edge1, way), area) / area_squared;
    const bool inside = u >= 0.0f && v >= 0.0f && u + v <= 1.0f;
    const bool parallel = std::fabs(dot(other.normal(), probe.normal)) >= kSameDirection;
    if (!inside || !parallel || std::fabs(dot(other.normal(), way)) > probe.distance) return false;
    probe.marks->set(instance, primitive);
    probe.marks->set(probe.instance, probe.primitive);
    return false;
}

void send_probe(RTCScene scene, SurfaceProbe& probe, vec3 place) {
    probe.place = place;
    RTCPointQuery query{place.x, place.y, place.z, 0.0f, probe.distance};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene, &query, &context, mark_what_is_shared, &probe);
}

}  // namespace

float largest_coordinate(RTCScene scene) {
    RTCBounds box;
    rtcGetSceneBounds(scene, &box);
    const float lower = std::max({std::fabs(box.lower_x), std::fabs(box.lower_y), std::fabs(box.lower_z)});
    return std::max({lower, std::fabs(box.upper_x), std::fabs(box.upper_y), std::fabs(box.upper_z)});
}

std::vector<SharedTriangle> find_shared_triangles(RTCScene scene, std::span<const InstanceGeometry> geometry) {
    std::vector<SharedTriangle> tasks;  // where each begins
    for (uint instance = 0; instance < geometry.size(); ++instance) {
        for (uint first = 0; first < geometry[instance].triangle_count; first += kTrianglesPerTask)
            tasks.push_back({instance, first});
    }
    Marks marks(geometry);
    const float extent = largest_coordinate(scene), distance = kSharedDistance * extent;
    for_each_tile(static_cast<uint>(tasks.size()), [&](uint task) {
        const uint instance = tasks[task].instance;
        SurfaceProbe probe{geometry, &marks, instance, 0, distance, {}, {}};
        const uint end = std::min(tasks[task].primitive + kTrianglesPerTask, geometry[instance].triangle_count);
        for (probe.primitive = tasks[task].primitive; probe.primitive < end; ++probe.primitive) {
            const WorldTriangle triangle(geometry[instance], probe.primitive);
            probe.normal = triangle.normal();
            send_probe(scene, probe, triangle.at(1.0f / 3.0f, 1.0f / 3.0f));
            if (triangle.reach() < kLongEdge * extent) continue;
            for (const auto& [u, v] : {std::pair(0.05f, 0.05f), std::pair(0.9f, 0.05f), std::pair(0.05f, 0.9f)})
                send_probe(scene, probe, triangle.at(u, v));
        }
    });
    std::vector<SharedTriangle> found;
    for (uint instance = 0; instance < geometry.size(); ++instance) {
        for (uint primitive = 0; primitive < geometry[instance].triangle_count; ++primitive) {
            if (marks.has(instance, primitive)) found.push_back({instance, primitive});
        }
    }
    return found;
}

}  // namespace target_core
