// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "application/locate/path_comparison.h"

namespace application {

using render_system::HostScene;
using render_system::NONE;

namespace {

/// How far rounding moves a hit, per unit of the largest coordinate at work; some 30 units in the last place.
constexpr double kRounding = 4.0e-6;

/// Where a ray meets a triangle's plane, and how far inside the triangle that is: the smallest barycentric coordinate
/// times the triangle's longest side. Lengths are in scene units.
struct PlaneHit {
    double distance = 0.0;
    double inside = 0.0;
    double size = 0.0;  ///< the largest coordinate at work
};

std::optional<PlaneHit> plane_hit(const HostScene& scene, const glm::dvec3& origin, const glm::dvec3& direction,
                                  const PathHit& hit) {
    if (hit.instance >= scene.instances().size()) return std::nullopt;
    const render_system::HostInstance& instance = scene.instances()[hit.instance];
    if (instance.mesh >= scene.meshes().size()) return std::nullopt;
    const render_system::HostMesh& mesh = scene.meshes()[instance.mesh];
    if (hit.primitive >= mesh.triangles.size()) return std::nullopt;
    const glm::uvec4& corners = mesh.triangles[hit.primitive];
    glm::dvec3 v[3];
    for (int i = 0; i < 3; ++i) v[i] = transform_point(instance.transform, mesh.positions[corners[i]]);
    const glm::dvec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
    const double area = glm::dot(normal, normal), slope = glm::dot(normal, direction);
    if (area == 0.0 || slope == 0.0) return std::nullopt;
    PlaneHit result;
    result.distance = glm::dot(normal, v[0] - origin) / slope;
    const glm::dvec3 point = origin + direction * result.distance;
    result.inside = 1.0e300;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 &from = v[i], &to = v[(i + 1) % 3];
        const double share = glm::dot(glm::cross(to - from, point - from), normal) / area;
        result.inside = std::min(result.inside, share * glm::length(to - from));
        for (int c = 0; c < 3; ++c) result.size = std::max({result.size, std::abs(from[c]), std::abs(origin[c])});
    }
    // A ray that grazes the plane meets it at no certain distance.
    result.size *= std::sqrt(area) / std::max(std::abs(slope), 1.0e-300);
    return result;
}

}  // namespace

bool is_tie(const HostScene& scene, const float* origin, const float* direction, const PathHit& a, const PathHit& b) {
    const glm::dvec3 from(origin[0], origin[1], origin[2]), along(direction[0], direction[1], direction[2]);
    const auto near = plane_hit(scene, from, along, a), far = plane_hit(scene, from, along, b);
    if (near && far && std::abs(near->distance - far->distance) <= kRounding * std::max(near->size, far->size))
        return true;
    // Else one core passed a triangle by that the other met: a tie with what is beside it if that is at its border.
    const auto& met = near && (!far || near->distance <= far->distance) ? near : far;
    return met && std::abs(met->inside) <= kRounding * met->size;
}

}  // namespace application
