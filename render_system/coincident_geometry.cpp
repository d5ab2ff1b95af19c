// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/coincident_geometry.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace render_system::coincident {

namespace {

// Both of the largest coordinate: how far apart what lies in one place may be, and how wide a line seems where both
// ends of an edge are rounded, once by each instance's matrix.
constexpr float kNear = 1.0f / (1 << 18);
constexpr double kLine = 1.0 / (1 << 21);
constexpr float kOutOfReach = 1.0e18f;  // beyond, cores meet nothing

// The arithmetic of the kernels' transform_point.
glm::vec3 world_position(const PlacedMesh& mesh, uint32_t vertex) {
    const float* at = mesh.positions + size_t{vertex} * 3;
    const glm::vec3 p(at[0], at[1], at[2]);
    if (!mesh.transform) return p;
    const glm::vec4* rows = mesh.transform;
    return {((rows[0].x * p.x + rows[0].y * p.y) + rows[0].z * p.z) + rows[0].w,
            ((rows[1].x * p.x + rows[1].y * p.y) + rows[1].z * p.z) + rows[1].w,
            ((rows[2].x * p.x + rows[2].y * p.y) + rows[2].z * p.z) + rows[2].w};
}

float reach_of(const Corners& corners) {
    float reach = 0.0f;
    for (const glm::vec3& p : corners.p) {
        reach = std::max({reach, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
    return reach;
}

// A plane as a height over two axes.
struct Plane {
    glm::dvec3 normal;  // not of unit length
    double distance;

    explicit Plane(const Corners& corners)
        : normal(glm::cross(glm::dvec3(corners.p[1]) - glm::dvec3(corners.p[0]),
                            glm::dvec3(corners.p[2]) - glm::dvec3(corners.p[0]))),
          distance(glm::dot(normal, glm::dvec3(corners.p[0]))) {}
    double height(const glm::dvec2& at, int axis, int u, int v) const {
        return (distance - normal[u] * at.x - normal[v] * at.y) / normal[axis];
    }
};

Polygon flattened(const Corners& corners, int u, int v) {
    Polygon polygon;
    for (const glm::vec3& p : corners.p) polygon.p[polygon.count++] = {p[u], p[v]};
    return turned_left(polygon);
}

// Twice the area over the length around.
double width_of(const Polygon& polygon) {
    double doubled = 0.0, around = 0.0;
    for (int i = 0; i < polygon.count; ++i) {
        const glm::dvec2& p = polygon.p[i];
        const glm::dvec2& q = polygon.p[(i + 1) % polygon.count];
        doubled += p.x * q.y - p.y * q.x;
        around += glm::length(q - p);
    }
    return around > 0.0 ? doubled / around : 0.0;
}

// Whether all of `corners` are farther than `near` from a plane, on one side of it.
bool passes_by(const Plane& plane, double length, const Corners& corners, double near) {
    int above = 0, below = 0;
    for (const glm::vec3& p : corners.p) {
        const double height = (glm::dot(plane.normal, glm::dvec3(p)) - plane.distance) / length;
        above += height > near ? 1 : 0;
        below += height < -near ? 1 : 0;
    }
    return above == 3 || below == 3;
}

}  // namespace

Corners corners_of(const PlacedMesh& mesh, uint32_t primitive) {
    const uint32_t* vertices = mesh.triangles + size_t{primitive} * 4;
    return {{world_position(mesh, vertices[0]), world_position(mesh, vertices[1]), world_position(mesh, vertices[2])}};
}

WorldBox box_of(const Corners& corners) {
    const float reach = reach_of(corners);
    if (!(reach < kOutOfReach)) return {};
    const glm::vec3 room(reach * kNear);
    return {glm::min(glm::min(corners.p[0], corners.p[1]), corners.p[2]) - room,
            glm::max(glm::max(corners.p[0], corners.p[1]), corners.p[2]) + room};
}

bool overlap(const WorldBox& a, const WorldBox& b) {
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
           a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

void include(WorldBox& box, const WorldBox& other) {
    box.lower = glm::min(box.lower, other.lower);
    box.upper = glm::max(box.upper, other.upper);
}

WorldBox box_of(const PlacedMesh& mesh) {
    WorldBox box;
    if (mesh.vertex_count > 2 * mesh.triangle_count) {  // the vertices may be those of other meshes as well
        for (uint32_t i = 0; i < mesh.triangle_count; ++i) include(box, box_of(corners_of(mesh, i)));
        return box;
    }
    // A triangle shares its corners with others: a box around all vertices is made with a sixth of the work.
    float reach = 0.0f;
    for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
        const glm::vec3 p = world_position(mesh, i);
        const float own = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
        if (!(own < kOutOfReach)) continue;
        reach = std::max(reach, own);
        include(box, {p, p});
    }
    const glm::vec3 room(reach * kNear);
    return {box.lower - room, box.upper + room};
}

CornerBits sorted_bits(const Corners& corners) {
    CornerBits bits;
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec3& p = corners.p[i];
        const auto bits_of = [](float x) { return std::bit_cast<uint32_t>(x + 0.0f); };  // -0 is 0
        bits[i] = {bits_of(p.x), bits_of(p.y), bits_of(p.z)};
    }
    std::sort(bits.begin(), bits.end());
    return bits;
}

Polygon cut(const Polygon& polygon, const glm::dvec2& a, const glm::dvec2& b) {
    const auto side = [&](const glm::dvec2& p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
    Polygon left;
    for (int i = 0; i < polygon.count; ++i) {
        const glm::dvec2& from = polygon.p[i];
        const glm::dvec2& to = polygon.p[(i + 1) % polygon.count];
        const double s = side(from), t = side(to);
        if (s >= 0.0) left.p[left.count++] = from;
        if ((s < 0.0) != (t < 0.0)) left.p[left.count++] = from + (to - from) * (s / (s - t));
    }
    return left;
}

Polygon turned_left(Polygon triangle) {
    const glm::dvec2 a = triangle.p[1] - triangle.p[0], b = triangle.p[2] - triangle.p[0];
    if (a.x * b.y - a.y * b.x < 0.0) std::swap(triangle.p[1], triangle.p[2]);
    return triangle;
}

bool shares_surface(const Corners& a, const Corners& b) {
    const double reach = static_cast<double>(std::max(reach_of(a), reach_of(b)));
    const double near = reach * static_cast<double>(kNear);
    const Plane plane_a(a), plane_b(b);
    const double length_a = glm::length(plane_a.normal), length_b = glm::length(plane_b.normal);
    if (!(length_a > 0.0) || !(length_b > 0.0)) return false;
    if (std::fabs(glm::dot(plane_a.normal, plane_b.normal)) < 0.9 * length_a * length_b) return false;
    if (passes_by(plane_a, length_a, b, near)) return false;
    const glm::dvec3 size = glm::abs(plane_a.normal);
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Polygon common = flattened(b, u, v);
    const Polygon frame = flattened(a, u, v);
    for (int i = 0; i < 3 && common.count > 0; ++i) common = cut(common, frame.p[i], frame.p[(i + 1) % 3]);
    if (width_of(common) < reach * kLine) return false;
    const double slant = size[axis] / length_a;
    return std::all_of(common.p, common.p + common.count, [&](const glm::dvec2& p) {
        return std::fabs(plane_a.height(p, axis, u, v) - plane_b.height(p, axis, u, v)) * slant <= near;
    });
}

}  // namespace render_system::coincident
