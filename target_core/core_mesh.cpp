// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/core_mesh.h"

#include <algorithm>
#include <cmath>

#include "target_core/core_tables.h"
#include "target_core/device/surface_order.h"
#include "target_core/kernels/intersect.h"

namespace target_core {

using namespace render_system;

namespace {

// Replaces `count` elements from `first` on by `rows`, moving what follows.
template <class Row>
void splice(std::vector<Row>& table, size_t first, size_t count, const std::vector<Row>& rows) {
    auto begin = table.begin() + static_cast<ptrdiff_t>(first);
    if (count == rows.size()) {
        std::copy(rows.begin(), rows.end(), begin);
        return;
    }
    table.erase(begin, begin + static_cast<ptrdiff_t>(count));
    table.insert(table.begin() + static_cast<ptrdiff_t>(first), rows.begin(), rows.end());
}

bool is_identity(const CoreTransform& transform) {
    const CoreTransform identity;
    return std::equal(std::begin(transform.rows), std::end(transform.rows), std::begin(identity.rows));
}

vec4 row_of(const glm::vec4& row) { return vec4(row.x, row.y, row.z, row.w); }

}  // namespace

void CoreMeshes::set_mesh(uint id, const CoreMesh& data) {
    if (id == meshes_.size()) {
        meshes_.emplace_back();
        meshes_.back().first_triangle = mesh_triangles_.size();
        meshes_.back().first_vertex = tangents_.size();
    }
    Mesh& mesh = meshes_[id];
    std::vector<uvec4> triangles;
    triangles.reserve(data.triangles.size());
    mesh.materials.clear();
    for (const glm::uvec4& t : data.triangles) {
        triangles.push_back(uvec4(t.x, t.y, t.z, t.w));
        if (mesh.materials.empty() || mesh.materials.back() != t.w) {
            mesh.materials.push_back(t.w);
        }
    }
    std::sort(mesh.materials.begin(), mesh.materials.end());
    mesh.materials.erase(std::unique(mesh.materials.begin(), mesh.materials.end()), mesh.materials.end());
    mesh.positions.resize(data.positions.size() + 1);
    std::transform(data.positions.begin(), data.positions.end(), mesh.positions.begin(), [](const glm::vec3& p) {
        return PackedVertex{p.x, p.y, p.z};
    });
    mesh.baked = {};
    mesh.has_tangents = !data.tangents.empty();
    mesh.has_colors = !data.colors.empty();
    splice(mesh_triangles_, mesh.first_triangle, mesh.triangle_count, triangles);
    splice(vertices_, mesh.first_vertex * VERTEX_ROWS, mesh.vertex_count * VERTEX_ROWS, pack_vertices(data));
    splice(tangents_, mesh.first_vertex, mesh.vertex_count, pack_tangents(data));
    for (size_t later = id + 1; later < meshes_.size(); ++later) {
        meshes_[later].first_triangle += triangles.size() - mesh.triangle_count;
        meshes_[later].first_vertex += data.positions.size() - mesh.vertex_count;
    }
    mesh.triangle_count = triangles.size();
    mesh.vertex_count = data.positions.size();
}

void CoreMeshes::set_instance(uint id, uint mesh, const CoreTransform& transform) {
    if (id == placed_.size()) {
        placed_.emplace_back();
    }
    placed_[id] = {mesh, transform};
}

bool CoreMeshes::lets_rays_pass(const Mesh& mesh, std::span<const CoreMaterial> materials) const {
    return std::any_of(mesh.materials.begin(), mesh.materials.end(),
                       [&](uint material) { return opacity_code(materials[material], mesh.has_colors) < 1.0f; });
}

void CoreMeshes::bake(Mesh& mesh, const CoreTransform& transform) {
    if (is_identity(transform)) {
        mesh.baked = {};
        return;
    }
    mesh.baked.resize(mesh.positions.size());
    vec4 row0 = row_of(transform.rows[0]);
    vec4 row1 = row_of(transform.rows[1]);
    vec4 row2 = row_of(transform.rows[2]);
    std::transform(mesh.positions.begin(), mesh.positions.end(), mesh.baked.begin(), [&](const PackedVertex& p) {
        kernels::vec3 w = kernels::transform_point(row0, row1, row2, kernels::vec3(p.x, p.y, p.z));
        return PackedVertex{w.x, w.y, w.z};
    });
}

void CoreMeshes::place(std::span<const CoreMaterial> materials, float reach) {
    // Meshes came one by one; what the tables grew ahead is given back.
    mesh_triangles_.shrink_to_fit();
    vertices_.shrink_to_fit();
    tangents_.shrink_to_fit();
    std::vector<uint> uses(meshes_.size(), 0);
    for (const Instance& instance : placed_) {
        if (instance.mesh != render_system::NONE) {
            ++uses[instance.mesh];
        }
    }
    geometry_.assign(placed_.size(), {});
    instances_.assign(placed_.size() * INSTANCE_ROWS, vec4(0.0f));
    for (size_t i = 0; i < placed_.size(); ++i) {
        if (placed_[i].mesh == render_system::NONE) {
            continue;
        }
        Mesh& mesh = meshes_[placed_[i].mesh];
        const CoreTransform& transform = placed_[i].transform;
        InstanceGeometry& geometry = geometry_[i];
        geometry.baked = uses[placed_[i].mesh] == 1;
        if (geometry.baked) {
            bake(mesh, transform);
        } else {
            mesh.baked = {};
        }
        geometry.positions = mesh.baked.empty() ? mesh.positions.data() : mesh.baked.data();
        geometry.triangles = mesh_triangles_.data() + mesh.first_triangle;
        geometry.vertex_count = static_cast<uint>(mesh.vertex_count);
        geometry.triangle_count = static_cast<uint>(mesh.triangle_count);
        geometry.mesh = placed_[i].mesh;
        geometry.reach = reach;
        geometry.lets_rays_pass = lets_rays_pass(mesh, materials);
        for (int r = 0; r < 3; ++r) {
            geometry.rows[r] = row_of(transform.rows[r]);
        }
        pack_instance(transform, static_cast<uint>(mesh.first_triangle), static_cast<uint>(mesh.first_vertex),
                      mesh.has_tangents, &instances_[i * INSTANCE_ROWS]);
    }
    assign_bins(geometry_);
}

bool CoreMeshes::passing_changed(std::span<const CoreMaterial> materials) const {
    for (const InstanceGeometry& geometry : geometry_) {
        if (geometry.triangle_count > 0 &&
            geometry.lets_rays_pass != lets_rays_pass(meshes_[geometry.mesh], materials)) {
            return true;
        }
    }
    return false;
}

bool CoreMeshes::has_colors() const {
    return std::any_of(meshes_.begin(), meshes_.end(), [](const Mesh& mesh) { return mesh.has_colors; });
}

uint CoreMeshes::features(std::span<const CoreMaterial> materials) const {
    uint features = has_colors() ? FEATURE_VERTEX_COLORS : 0u;
    for (const InstanceGeometry& geometry : geometry_) {
        features |= geometry.triangle_count > 0 && !geometry.baked ? FEATURE_INSTANCES : 0u;
        features |= geometry.lets_rays_pass ? FEATURE_ALPHA : 0u;
    }
    for (const CoreMaterial& material : materials) {
        features |= opacity_code(material, has_colors()) < 0.0f ? FEATURE_ALPHA_TEXTURES : 0u;
    }
    return features;
}

uint64_t CoreMeshes::memory_bytes() const {
    uint64_t bytes = mesh_triangles_.capacity() * sizeof(uvec4) + vertices_.capacity() * sizeof(vec4) +
                     tangents_.capacity() * sizeof(uint) + instances_.capacity() * sizeof(vec4);
    for (const Mesh& mesh : meshes_) {
        bytes += (mesh.positions.capacity() + mesh.baked.capacity()) * sizeof(PackedVertex);
    }
    return bytes;
}

uint64_t CoreMeshes::traced_bytes() const {
    uint64_t bytes = mesh_triangles_.size() * sizeof(uvec4);
    for (const Mesh& mesh : meshes_) {
        bytes += mesh.positions.size() * sizeof(PackedVertex);
    }
    return bytes;
}

}  // namespace target_core
