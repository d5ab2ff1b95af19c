// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/animation/deformation.h"

#include <algorithm>
#include <cmath>

#include "render_system/host_scene.h"

namespace render_system {

namespace {

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& fallback) {
    const float size = glm::length(v);
    return size > 0.0f && std::isfinite(size) ? v / size : fallback;
}

template <class Vec>
void add_scaled(std::vector<Vec>& array, const std::vector<glm::vec3>& offsets, float weight) {
    for (size_t i = 0; i < offsets.size(); ++i) {
        for (int c = 0; c < 3; ++c) array[i][c] += weight * offsets[i][c];
    }
}

void morph(const RestMesh& rest, std::span<const double> weights, HostMesh& mesh) {
    bool bent = false;
    for (size_t i = 0; i < std::min(rest.targets.size(), weights.size()); ++i) {
        const auto weight = static_cast<float>(weights[i]);
        if (weight == 0.0f) continue;
        const MorphTarget& target = rest.targets[i];
        add_scaled(mesh.positions, target.positions, weight);
        add_scaled(mesh.normals, target.normals, weight);
        if (!mesh.tangents.empty()) add_scaled(mesh.tangents, target.tangents, weight);
        bent = bent || !target.normals.empty() || !target.tangents.empty();
    }
    if (!bent) return;
    for (size_t i = 0; i < mesh.normals.size(); ++i) mesh.normals[i] = unit_or(mesh.normals[i], rest.normals[i]);
    for (size_t i = 0; i < mesh.tangents.size(); ++i) {
        const glm::vec3 way = unit_or(glm::vec3(mesh.tangents[i]), glm::vec3(rest.tangents[i]));
        mesh.tangents[i] = glm::vec4(way, rest.tangents[i].w);
    }
}

glm::mat4 pull_of(const RestMesh& rest, size_t vertex, std::span<const glm::mat4> matrices) {
    glm::mat4 pull(0.0f);
    for (size_t i = vertex * rest.influences; i < (vertex + 1) * rest.influences; ++i) {
        if (rest.weights[i] != 0.0f) pull += matrices[rest.joints[i]] * rest.weights[i];
    }
    return pull;
}

void skin(const RestMesh& rest, std::span<const glm::mat4> matrices, HostMesh& mesh) {
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::mat4 pull = pull_of(rest, i, matrices);
        const glm::vec3 x(pull[0]), y(pull[1]), z(pull[2]), normal = mesh.normals[i];
        mesh.positions[i] = glm::vec3(pull * glm::vec4(mesh.positions[i], 1.0f));
        const glm::vec3 turned =
            glm::cross(y, z) * normal.x + glm::cross(z, x) * normal.y + glm::cross(x, y) * normal.z;
        mesh.normals[i] = unit_or(turned, normal);
        if (mesh.tangents.empty()) continue;
        const glm::vec3 tangent(mesh.tangents[i]);
        mesh.tangents[i] = glm::vec4(unit_or(glm::mat3(pull) * tangent, tangent), mesh.tangents[i].w);
    }
}

}  // namespace

glm::vec3 flat_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::dvec3 way = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
    const double size = glm::length(way);
    return size > 0.0 && std::isfinite(size) ? glm::vec3(way / size) : glm::vec3(0.0f, 0.0f, 1.0f);
}

void deform(const RestMesh& rest, std::span<const double> weights, std::span<const glm::mat4> matrices,
            HostMesh& mesh) {
    mesh.positions = rest.positions;
    mesh.normals = rest.normals;
    mesh.tangents = rest.tangents;
    morph(rest, weights, mesh);
    if (!matrices.empty() && rest.influences > 0) skin(rest, matrices, mesh);
    for (const TriangleRange& range : rest.flat) {
        for (uint32_t i = range.first; i < range.end; ++i) {
            const glm::uvec4& t = mesh.triangles[i];
            const glm::vec3 normal = flat_normal(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
            mesh.normals[t.x] = mesh.normals[t.y] = mesh.normals[t.z] = normal;
        }
    }
}

}  // namespace render_system
