// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/core_mesh.h"

#include <algorithm>
#include <cmath>

#include "render_system/give_back.h"
#include "target_core/core_tables.h"
#include "target_core/device/surface_order.h"
#include "target_core/kernels/intersect.h"

namespace target_core {

using namespace render_system;

namespace {

// Room for `count` rows in place of `before` from `first` on, moving what follows: to be written there, since rows that
// were put together elsewhere would be in memory twice.
template <class Row>
Row* make_room(std::vector<Row>& table, size_t first, size_t before, size_t count) {
    const auto end = table.begin() + static_cast<ptrdiff_t>(first + before);
    if (count > before) {
        table.insert(end, count - before, Row{});
    } else {
        table.erase(end - static_cast<ptrdiff_t>(before - count), end);
    }
    return table.data() + first;
}

bool is_identity(const CoreTransform& transform) {
    const CoreTransform identity;
    return std::equal(std::begin(transform.rows), std::end(transform.rows), std::begin(identity.rows));
}

vec4 row_of(const glm::vec4& row) { return vec4(row.x, row.y, row.z, row.w); }

std::vector<PackedVertex> packed_positions(const CoreMesh& data) {
    std::vector<PackedVertex> positions(data.positions.size() + 1);
    std::transform(data.positions.begin(), data.positions.end(), positions.begin(), [](const glm::vec3& p) {
        return PackedVertex{p.x, p.y, p.z};
    });
    return positions;
}

// A box that grows.
struct Reach {
    glm::vec3 lower{1e30f};
    glm::vec3 upper{-1e30f};

    void include(const PackedVertex& p) {
        lower = glm::min(lower, glm::vec3(p.x, p.y, p.z));
        upper = glm::max(upper, glm::vec3(p.x, p.y, p.z));
    }
    void include(const Reach& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }
    double half_area() const {
        glm::dvec3 size = glm::dvec3(upper) - glm::dvec3(lower);
        return size.x * size.y + size.y * size.z + size.z * size.x;
    }
};

// How much a fitted tree may be worse than a built one.
constexpr double kWorn = 1.4;

}  // namespace

bool CoreMeshes::has_shape_of(const Mesh& mesh, const CoreMesh& data) const {
    if (mesh.vertex_count != data.positions.size() || mesh.triangle_count != data.triangles.size() ||
        mesh.flags != vertex_flags(data))
        return false;
    const uvec4* triangle = mesh_triangles_.data() + mesh.first_triangle;
    return std::all_of(data.triangles.begin(), data.triangles.end(), [&](const glm::uvec4& t) {
        const uvec4& own = *triangle++;
        return own.x == t.x && own.y == t.y && own.z == t.z && own.w == t.w;
    });
}

// What a tree that was built over other places must cost by now, in the absence of a look into Embree's: the half areas
// of the boxes around every 32 triangles, which lie together in a mesh's list, over that of all. After Lauterbach et
// al. 2006, "RT-DEFORM", who compare the areas of nodes so and build anew at 1.4 times.
double CoreMeshes::spread_of(const Mesh& mesh) const {
    constexpr size_t kTogether = 32;
    Reach all, some;
    double sum = 0.0;
    for (size_t i = 0; i < mesh.triangle_count; ++i) {
        const uvec4& t = mesh_triangles_[mesh.first_triangle + i];
        some.include(mesh.positions[t.x]);
        some.include(mesh.positions[t.y]);
        some.include(mesh.positions[t.z]);
        if (i % kTogether + 1 < kTogether && i + 1 < mesh.triangle_count) continue;
        sum += some.half_area();
        all.include(some);
        some = {};
    }
    const double whole = mesh.triangle_count > 0 ? all.half_area() : 0.0;
    return whole > 0.0 ? sum / whole : 0.0;
}

// Where Embree and the tables have the mesh already, the vertices take their places.
void CoreMeshes::move_vertices(uint id, const CoreMesh& data) {
    Mesh& mesh = meshes_[id];
    std::vector<PackedVertex> positions = packed_positions(data);
    std::copy(positions.begin(), positions.end(), mesh.positions.begin());
    pack_vertices(data, vertices_.data() + mesh.first_vertex_row);
    mesh.is_baked = false;
    edits_.shape = edits_.shape || !mesh.deforms;
    edits_.deformed.push_back(id);
    is_alive_ = mesh.deforms = true;
    const double spread = spread_of(mesh);
    const bool worn = !(spread <= kWorn * mesh.spread);
    if (worn || edits_.shape) mesh.spread = spread;
    if (worn) edits_.worn.push_back(id);
}

void CoreMeshes::set_mesh(uint id, const CoreMesh& data) {
    if (id == meshes_.size()) {
        meshes_.emplace_back();
        meshes_.back().first_triangle = mesh_triangles_.size();
        meshes_.back().first_vertex_row = vertices_.size() - kSpareVertexRows;
        edits_.shape = true;  // also without a triangle: it is not there to be moved
    }
    Mesh& mesh = meshes_[id];
    if (!edits_.shape && has_shape_of(mesh, data)) {
        move_vertices(id, data);
        return;
    }
    edits_.shape = true;
    mesh.materials.clear();
    uvec4* own = make_room(mesh_triangles_, mesh.first_triangle, mesh.triangle_count, data.triangles.size());
    for (const glm::uvec4& t : data.triangles) {
        *own++ = uvec4(t.x, t.y, t.z, t.w);
        if (mesh.materials.empty() || mesh.materials.back() != t.w) {
            mesh.materials.push_back(t.w);
        }
    }
    std::sort(mesh.materials.begin(), mesh.materials.end());
    mesh.materials.erase(std::unique(mesh.materials.begin(), mesh.materials.end()), mesh.materials.end());
    mesh.positions = packed_positions(data);
    give_back(mesh.baked);
    mesh.is_baked = false;
    mesh.flags = vertex_flags(data);
    mesh.moves = mesh.moves || data.moves;
    mesh.deforms = mesh.deforms || data.deforms;
    is_alive_ = is_alive_ || mesh.moves || mesh.deforms;
    const size_t rows = vertex_row_count(data);
    pack_vertices(data, make_room(vertices_, mesh.first_vertex_row, mesh.vertex_row_count, rows));
    for (size_t later = id + 1; later < meshes_.size(); ++later) {
        meshes_[later].first_triangle += data.triangles.size() - mesh.triangle_count;
        meshes_[later].first_vertex_row += rows - mesh.vertex_row_count;
    }
    mesh.triangle_count = data.triangles.size();
    mesh.vertex_count = data.positions.size();
    mesh.vertex_row_count = rows;
    if (mesh.deforms) mesh.spread = spread_of(mesh);
}

std::vector<glm::vec3> CoreMeshes::positions_before(uint id, const CoreMesh& data) const {
    if (id >= meshes_.size() || !has_shape_of(meshes_[id], data)) return {};
    const std::vector<PackedVertex>& positions = meshes_[id].positions;
    std::vector<glm::vec3> places(data.positions.size());
    std::transform(positions.begin(), positions.begin() + static_cast<ptrdiff_t>(places.size()), places.begin(),
                   [](const PackedVertex& p) { return glm::vec3(p.x, p.y, p.z); });
    return places;
}

void CoreMeshes::set_instance(uint id, uint mesh, const CoreTransform& transform) {
    if (id == placed_.size()) {
        placed_.emplace_back();
        edits_.shape = true;
    }
    Instance& placed = placed_[id];
    if (placed.mesh == mesh && placed.transform == transform && !edits_.shape) return;
    edits_.shape = edits_.shape || placed.mesh != mesh;
    placed.mesh = mesh;
    placed.transform = transform;
    if (edits_.shape || mesh == NONE) return;
    // Once; then it is no longer baked, and its transform alone has to follow.
    edits_.shape = geometry_[id].baked;
    edits_.moved.push_back(id);
    moves_.resize(placed_.size(), false);
    moves_[id] = true;
    is_alive_ = true;
}

bool CoreMeshes::lets_rays_pass(const Mesh& mesh, std::span<const CoreMaterial> materials) const {
    return std::any_of(mesh.materials.begin(), mesh.materials.end(),
                       [&](uint material) { return opacity_code(materials[material], mesh.has_colors()) < 1.0f; });
}

void CoreMeshes::bake(Mesh& mesh, const CoreTransform& transform) {
    if (mesh.is_baked && mesh.placed_by == transform) return;
    mesh.is_baked = true;
    mesh.placed_by = transform;
    if (is_identity(transform)) {
        give_back(mesh.baked);
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

void CoreMeshes::place(std::span<const CoreMaterial> materials, float reach, bool still) {
    // Meshes came one by one; what the tables grew ahead is given back.
    mesh_triangles_.shrink_to_fit();
    vertices_.shrink_to_fit();
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
        geometry.baked =
            uses[placed_[i].mesh] == 1 && !(i < moves_.size() && moves_[i]) && !mesh.moves && !mesh.deforms;
        geometry.deforms = mesh.deforms;
        if (geometry.baked) {
            bake(mesh, transform);
            if (still && !mesh.baked.empty()) give_back(mesh.positions);
        } else {
            give_back(mesh.baked);
            mesh.is_baked = false;
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
        pack_instance(transform, static_cast<uint>(mesh.first_triangle), static_cast<uint>(mesh.first_vertex_row),
                      mesh.flags, &instances_[i * INSTANCE_ROWS]);
    }
    assign_bins(geometry_);
}

void CoreMeshes::find_coincident(CoincidentSurfaces& surfaces) const {
    std::vector<PlacedMesh> scene(geometry_.size());
    std::vector<uint> changed = edits_.moved;
    for (uint i = 0; i < geometry_.size(); ++i) {
        const InstanceGeometry& geometry = geometry_[i];
        if (geometry.triangle_count == 0) continue;
        const Mesh& mesh = meshes_[geometry.mesh];
        const glm::vec4* rows = geometry.baked ? nullptr : placed_[i].transform.rows;
        scene[i] = {&geometry.positions->x, geometry.vertex_count, &geometry.triangles->x, geometry.triangle_count,
                    rows};
        if (mesh.deforms && std::count(edits_.deformed.begin(), edits_.deformed.end(), geometry.mesh) > 0) {
            changed.push_back(i);
        }
    }
    if (edits_.shape) {
        surfaces.find(scene);
    } else {
        surfaces.follow(scene, changed);
    }
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
    return std::any_of(meshes_.begin(), meshes_.end(), [](const Mesh& mesh) { return mesh.has_colors(); });
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
                     instances_.capacity() * sizeof(vec4);
    for (const Mesh& mesh : meshes_) {
        bytes += (mesh.positions.capacity() + mesh.baked.capacity()) * sizeof(PackedVertex);
    }
    return bytes;
}

uint64_t CoreMeshes::traced_bytes() const {
    uint64_t bytes = mesh_triangles_.size() * sizeof(uvec4);
    for (const Mesh& mesh : meshes_) {
        bytes += (mesh.vertex_count + 1) * sizeof(PackedVertex);
    }
    return bytes;
}

}  // namespace target_core
