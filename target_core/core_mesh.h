// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render_system/coincident.h"
#include "render_system/core_data.h"
#include "target_core/core_tables.h"
#include "target_core/device/instance_geometry.h"
#include "target_core/kernels/layout.h"

namespace target_core {

/// What a tree has to follow.
struct GeometryEdits {
    bool shape = true;             ///< more than the rest says: all is built anew
    std::vector<uint> moved{};     ///< instances with another transform
    std::vector<uint> deformed{};  ///< meshes with other vertices
    std::vector<uint> worn{};      ///< of these, those that have drifted so far apart that their trees are built anew
};

/// All meshes and instances: the tables mesh_triangles, vertices and instances, and the positions that
/// Embree reads.
class CoreMeshes {
public:
    /// Stores mesh `id`, which must be known or the next free one. `data` has been validated.
    void set_mesh(uint id, const render_system::CoreMesh& data);

    /// Where the vertices of a mesh are, if `data` moves them and changes nothing else; else none.
    std::vector<glm::vec3> positions_before(uint id, const render_system::CoreMesh& data) const;

    /// Puts a mesh into the scene, or hides the instance if `mesh` is NONE.
    void set_instance(uint id, uint mesh, const render_system::CoreTransform& transform);

    /// What has happened since the last `settle`.
    const GeometryEdits& edits() const { return edits_; }
    void settle() { edits_ = {.shape = false}; }
    /// The tree is lost.
    void start_anew() { edits_.shape = true; }
    /// Whether an instance has moved or a mesh changed its shape since it was first there, or is said to.
    bool is_alive() const { return is_alive_; }

    /// Fills the instance table and `geometry()` for the materials at hand; bakes meshes of one instance that stand
    /// still. `reach` is the largest coordinate from which rays may come, where exact mode's boxes are to be padded for
    /// it. `still`: no mesh or instance will be set any more, so of what was baked nothing else is kept.
    void place(std::span<const render_system::CoreMaterial> materials, float reach = 0.0f, bool still = false);

    /// Finds what lies in one place, or follows the edits since the last `settle`. After `place`.
    void find_coincident(render_system::CoincidentSurfaces& surfaces) const;

    /// True if some instance's rays-may-pass mark would change with these materials: the scene must be placed anew.
    bool passing_changed(std::span<const render_system::CoreMaterial> materials) const;

    std::span<const InstanceGeometry> geometry() const { return geometry_; }
    const std::vector<uvec4>& mesh_triangles() const { return mesh_triangles_; }
    const std::vector<vec4>& vertices() const { return vertices_; }
    const std::vector<vec4>& instances() const { return instances_; }
    bool has_colors() const;
    /// FEATURE_INSTANCES, FEATURE_ALPHA, FEATURE_ALPHA_TEXTURES and FEATURE_VERTEX_COLORS.
    uint features(std::span<const render_system::CoreMaterial> materials) const;
    uint64_t memory_bytes() const;
    /// Of these, what Embree reads: indices, and the vertices of instances.
    uint64_t traced_bytes() const;

private:
    struct Mesh {
        std::vector<PackedVertex> positions;  // one more at the end: Embree reads 16 bytes per vertex
        std::vector<PackedVertex> baked;      // the same in world space, where a transform needs it
        size_t first_triangle = 0;
        size_t triangle_count = 0;
        size_t first_vertex_row = 0;
        size_t vertex_row_count = 0;
        size_t vertex_count = 0;
        uint flags = 0;      // INSTANCE_HAS_...
        bool moves = false;  // some instance of it does; of those that nobody told of moves_ knows
        bool deforms = false;
        bool is_baked = false;                   // `baked` is that of `placed_by`
        render_system::CoreTransform placed_by;  // of the last bake
        double spread = 0.0;                     // spread_of, when its tree was built
        std::vector<uint> materials;             // the distinct ones

        bool has_colors() const { return (flags & INSTANCE_HAS_COLORS) != 0; }
    };
    struct Instance {
        uint mesh = render_system::NONE;
        render_system::CoreTransform transform;
    };
    void move_vertices(uint id, const render_system::CoreMesh& data);
    bool has_shape_of(const Mesh& mesh, const render_system::CoreMesh& data) const;
    double spread_of(const Mesh& mesh) const;
    bool lets_rays_pass(const Mesh& mesh, std::span<const render_system::CoreMaterial> materials) const;
    void bake(Mesh& mesh, const render_system::CoreTransform& transform);

    std::vector<Mesh> meshes_;
    std::vector<Instance> placed_;
    std::vector<bool> moves_;  // by instance
    GeometryEdits edits_;
    bool is_alive_ = false;
    std::vector<InstanceGeometry> geometry_;
    std::vector<uvec4> mesh_triangles_;
    std::vector<vec4> vertices_ = std::vector<vec4>(kSpareVertexRows, vec4(0.0f));
    std::vector<vec4> instances_;
};

}  // namespace target_core
