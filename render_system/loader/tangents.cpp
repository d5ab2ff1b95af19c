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

// Vertices with the same key share one tangent.
struct Key {
    float values[9];  // position, normal, uv, handedness

    bool operator==(const Key& other) const { return std::memcmp(values, other.values, sizeof(values)) == 0; }
};

struct Corner {
    glm::vec3 direction{0.0f};  // in the plane of the normal, as long as the corner's angle; 0 if there is none
    float handedness = 1.0f;
};

glm::vec2 uv_of(const HostMesh& mesh, const CoreTextureSlot& slot, uint32_t vertex) {
    const std::vector<glm::vec2>& set = mesh.uv(slot.uv_set);
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

Key key_of(const HostMesh& mesh, const CoreTextureSlot& slot, uint32_t vertex) {
    const glm::vec3 p = mesh.positions[vertex], n = mesh.normals[vertex];
    const glm::vec2 uv = uv_of(mesh, slot, vertex);
    return {{p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y, mesh.tangents[vertex].w}};
}

// FNV-1a, over words.
uint64_t hash_of(const Key& key) {
    uint64_t hash = 0xCBF29CE484222325u;
    for (float value : key.values) {
        uint32_t bits;
        std::memcpy(&bits, &value, sizeof(bits));
        hash = (hash ^ bits) * 0x100000001B3u;
        hash ^= hash >> 29;
    }
    return hash;
}

// Of each vertex from `first` on, whose tangents' w is their handedness, the lowest that shares its tangent. Finding it
// takes 9 bytes a vertex, where a table of the keys themselves takes 80.
std::vector<uint32_t> sharing_vertices(const HostMesh& mesh, const CoreTextureSlot& slot, size_t first) {
    const size_t count = mesh.positions.size() - first;
    std::vector<uint32_t> table(count + count / 4 + 1, NONE), lowest(count);
    for (size_t i = 0; i < count; ++i) {
        const auto vertex = static_cast<uint32_t>(first + i);
        const Key key = key_of(mesh, slot, vertex);
        size_t at = hash_of(key) % table.size();
        while (table[at] != NONE && !(key_of(mesh, slot, table[at]) == key)) at = at + 1 < table.size() ? at + 1 : 0;
        if (table[at] == NONE) table[at] = vertex;
        lowest[i] = table[at];
    }
    return lowest;
}

uint32_t duplicate_vertex(HostMesh& mesh, uint32_t vertex) {
    mesh.positions.push_back(glm::vec3(mesh.positions[vertex]));
    mesh.normals.push_back(glm::vec3(mesh.normals[vertex]));
    mesh.tangents.push_back(glm::vec4(0.0f));
    for (std::vector<glm::vec2>* set : {&mesh.uv0, &mesh.uv1, &mesh.uv2, &mesh.uv3}) {
        if (!set->empty()) set->push_back(glm::vec2((*set)[vertex]));
    }
    if (!mesh.colors.empty()) mesh.colors.push_back(glm::vec4(mesh.colors[vertex]));
    return static_cast<uint32_t>(mesh.positions.size() - 1);
}

// Gives each corner a vertex of its own handedness, which is its tangent's w from then on. Answers what those added
// were split from.
std::vector<uint32_t> split_vertices(HostMesh& mesh, size_t first_vertex, size_t first_triangle,
                                     const CoreTextureSlot& slot) {
    std::unordered_map<uint32_t, uint32_t> twin;
    std::vector<uint32_t> sources;
    for (size_t i = first_triangle; i < mesh.triangles.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const Corner corner = corner_of(mesh, slot, mesh.triangles[i], c);
            if (corner.direction == glm::vec3(0.0f)) continue;
            uint32_t& vertex = mesh.triangles[i][c];
            float& own = mesh.tangents[vertex].w;  // 0: not decided yet
            if (own == 0.0f) own = corner.handedness;
            if (own == corner.handedness) continue;
            const auto [entry, is_new] = twin.try_emplace(vertex, 0);
            if (is_new) {
                entry->second = duplicate_vertex(mesh, vertex);
                mesh.tangents[entry->second].w = corner.handedness;
                sources.push_back(uint32_t{vertex});
            }
            vertex = entry->second;
        }
    }
    for (size_t vertex = first_vertex; vertex < mesh.positions.size(); ++vertex) {
        if (mesh.tangents[vertex].w == 0.0f) mesh.tangents[vertex].w = 1.0f;
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
    std::vector<uint32_t> sources = split_vertices(mesh, first_vertex, first_triangle, slot);
    const std::vector<uint32_t> lowest = sharing_vertices(mesh, slot, first_vertex);
    for (size_t i = first_triangle; i < mesh.triangles.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            glm::vec4& sum = mesh.tangents[lowest[mesh.triangles[i][c] - first_vertex]];
            sum += glm::vec4(corner_of(mesh, slot, mesh.triangles[i], c).direction, 0.0f);
        }
    }
    // The lowest holds the sum, and comes last.
    for (size_t vertex = mesh.positions.size(); vertex-- > first_vertex;) {
        const glm::vec4 sum = mesh.tangents[lowest[vertex - first_vertex]];
        const glm::vec3 tangent = unit_or_zero(glm::vec3(sum));
        mesh.tangents[vertex] =
            glm::vec4(tangent != glm::vec3(0.0f) ? tangent : any_tangent(mesh.normals[vertex]), sum.w);
    }
    return sources;
}

}  // namespace render_system
