// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/tangents.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>
#include <vector>

namespace render_system {

namespace {

// Corners with the same key share one tangent.
struct Key {
    float values[9];  // position, normal, uv, handedness

    bool operator==(const Key& other) const { return std::memcmp(values, other.values, sizeof(values)) == 0; }
};

struct KeyHash {
    size_t operator()(const Key& key) const {
        uint64_t hash = 0xCBF29CE484222325u;  // FNV-1a, over words
        for (float value : key.values) {
            uint32_t bits;
            std::memcpy(&bits, &value, sizeof(bits));
            hash = (hash ^ bits) * 0x100000001B3u;
        }
        return static_cast<size_t>(hash ^ hash >> 29);
    }
};

struct Corner {
    glm::vec3 direction{0.0f};  // in the plane of the normal, as long as the corner's angle; 0 if there is none
    float handedness = 1.0f;
};

glm::vec2 uv_of(const HostMesh& mesh, const CoreTextureSlot& slot, uint32_t vertex) {
    const std::vector<glm::vec2>& set = slot.uv_set == 0 ? mesh.uv0 : mesh.uv1;
    if (set.empty()) return glm::vec2(0.0f);
    const glm::vec3 uv(set[vertex], 1.0f);
    return {glm::dot(slot.row_u, uv), glm::dot(slot.row_v, uv)};
}

glm::vec3 unit_or_zero(const glm::vec3& v) {
    const float size = glm::length(v);
    return size > 0.0f && std::isfinite(size) ? v / size : glm::vec3(0.0f);
}

float angle_between(const glm::vec3& a, const glm::vec3& b) {
    const float cosine = glm::dot(unit_or_zero(a), unit_or_zero(b));
    return std::acos(std::clamp(cosine, -1.0f, 1.0f));
}

Corner corner_of(const HostMesh& mesh, const CoreTextureSlot& slot, const glm::uvec4& triangle, int corner) {
    const uint32_t v[3] = {triangle[corner], triangle[(corner + 1) % 3], triangle[(corner + 2) % 3]};
    const glm::vec3 e1 = mesh.positions[v[1]] - mesh.positions[v[0]];
    const glm::vec3 e2 = mesh.positions[v[2]] - mesh.positions[v[0]];
    const glm::vec2 d1 = uv_of(mesh, slot, v[1]) - uv_of(mesh, slot, v[0]);
    const glm::vec2 d2 = uv_of(mesh, slot, v[2]) - uv_of(mesh, slot, v[0]);
    const float determinant = d1.x * d2.y - d1.y * d2.x;
    Corner result;
    if (determinant == 0.0f || !std::isfinite(determinant)) return result;
    // In glTF v grows downwards in the image, while a normal map's green points up: a picture seen upright from the
    // front (determinant below 0) has the bitangent cross(normal, tangent), that is w = 1.
    result.handedness = determinant < 0.0f ? 1.0f : -1.0f;
    const glm::vec3 normal = mesh.normals[v[0]];
    const glm::vec3 growing_u = (e1 * d2.y - e2 * d1.y) * -result.handedness;
    result.direction = unit_or_zero(growing_u - normal * glm::dot(normal, growing_u)) * angle_between(e1, e2);
    return result;
}

Key key_of(const HostMesh& mesh, const CoreTextureSlot& slot, uint32_t vertex, float handedness) {
    const glm::vec3 p = mesh.positions[vertex], n = mesh.normals[vertex];
    const glm::vec2 uv = uv_of(mesh, slot, vertex);
    return {{p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y, handedness}};
}

uint32_t duplicate_vertex(HostMesh& mesh, uint32_t vertex) {
    mesh.positions.push_back(glm::vec3(mesh.positions[vertex]));
    mesh.normals.push_back(glm::vec3(mesh.normals[vertex]));
    mesh.tangents.push_back(glm::vec4(0.0f));
    if (!mesh.uv0.empty()) mesh.uv0.push_back(glm::vec2(mesh.uv0[vertex]));
    if (!mesh.uv1.empty()) mesh.uv1.push_back(glm::vec2(mesh.uv1[vertex]));
    if (!mesh.colors.empty()) mesh.colors.push_back(glm::vec4(mesh.colors[vertex]));
    return static_cast<uint32_t>(mesh.positions.size() - 1);
}

// Gives each corner a vertex of its own handedness. Answers what those added were split from.
std::vector<uint32_t> split_vertices(HostMesh& mesh, size_t first_vertex, size_t first_triangle,
                                     const std::vector<Corner>& corners) {
    std::vector<float> handedness(mesh.positions.size() - first_vertex, 0.0f);  // 0: not decided yet
    std::unordered_map<uint32_t, uint32_t> twin;
    std::vector<uint32_t> sources;
    for (size_t i = 0; i < corners.size(); ++i) {
        uint32_t& vertex = mesh.triangles[first_triangle + i / 3][static_cast<int>(i % 3)];
        float& own = handedness[vertex - first_vertex];
        if (corners[i].direction == glm::vec3(0.0f)) continue;
        if (own == 0.0f) own = corners[i].handedness;
        if (own == corners[i].handedness) continue;
        const auto [entry, is_new] = twin.try_emplace(vertex, 0);
        if (is_new) {
            entry->second = duplicate_vertex(mesh, vertex);
            sources.push_back(uint32_t{vertex});
        }
        vertex = entry->second;
    }
    return sources;
}

}  // namespace

glm::vec3 any_tangent(const glm::vec3& normal) {
    const glm::vec3 axis = std::abs(normal.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(axis - normal * glm::dot(normal, axis));
}

std::vector<uint32_t> generate_tangents(HostMesh& mesh, size_t first_vertex, size_t first_triangle,
                                        const CoreTextureSlot& slot) {
    const size_t corner_count = (mesh.triangles.size() - first_triangle) * 3;
    std::vector<Corner> corners(corner_count);
    std::unordered_map<Key, glm::vec3, KeyHash> sums;
    const auto vertex_of = [&](size_t corner) {
        return mesh.triangles[first_triangle + corner / 3][static_cast<int>(corner % 3)];
    };
    for (size_t i = 0; i < corner_count; ++i) {
        corners[i] = corner_of(mesh, slot, mesh.triangles[first_triangle + i / 3], static_cast<int>(i % 3));
        sums[key_of(mesh, slot, vertex_of(i), corners[i].handedness)] += corners[i].direction;
    }
    std::vector<uint32_t> sources = split_vertices(mesh, first_vertex, first_triangle, corners);
    for (size_t i = 0; i < corner_count; ++i) {
        const uint32_t vertex = vertex_of(i);
        const glm::vec3 tangent = unit_or_zero(sums[key_of(mesh, slot, vertex, corners[i].handedness)]);
        if (tangent != glm::vec3(0.0f)) mesh.tangents[vertex] = glm::vec4(tangent, corners[i].handedness);
    }
    for (size_t vertex = first_vertex; vertex < mesh.positions.size(); ++vertex) {
        if (glm::vec3(mesh.tangents[vertex]) != glm::vec3(0.0f)) continue;
        mesh.tangents[vertex] = glm::vec4(any_tangent(mesh.normals[vertex]), 1.0f);
    }
    return sources;
}

}  // namespace render_system
