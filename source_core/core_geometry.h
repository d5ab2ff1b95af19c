// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "render_system/core_data.h"
#include "render_system/status.h"
#include "source_core/acceleration/bvh.h"
#include "source_core/kernels/layout.h"

namespace source_core {

/// A mesh as the core keeps it: what the tree is built from, and its rows of the tables.
struct CoreMeshCopy {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec4> triangles;
    std::vector<glm::vec4> vertex_rows;
    uint32_t flags = 0;  // INSTANCE_HAS_...

    bool has_colors() const { return (flags & INSTANCE_HAS_COLORS) != 0; }
};

struct CoreInstance {
    uint32_t mesh = render_system::NONE;  // NONE: hidden
    render_system::CoreTransform transform;
};

/// What has moved or changed its shape since it was first built, or is said to: by id; what is past the end has not.
struct MovingParts {
    std::vector<bool> instances;
    std::vector<bool> meshes;  // that change their shape
    std::vector<bool> placed;  // meshes of which some instance moves

    bool moves(uint32_t instance, uint32_t mesh) const {
        return is_set(instances, instance) || is_set(placed, mesh) || deforms(mesh);
    }
    bool deforms(uint32_t mesh) const { return is_set(meshes, mesh); }
    static bool is_set(const std::vector<bool>& flags, uint32_t id) { return id < flags.size() && flags[id]; }
};

/// Where a build has put a mesh.
struct MeshPlan {
    uint32_t first_triangle = 0;  ///< rows of the tables
    uint32_t first_vertex_row = 0;
    uint32_t first_slot = 0;
    uint32_t first_node = 0;
    uint32_t node_room = 0;
    bool is_empty = true;   ///< no tree, or one of nothing
    glm::vec3 lower{0.0f};  ///< of the tree
    glm::vec3 upper{0.0f};
    WideTree tree;            ///< of a mesh that deforms, to be fitted again
    double built_cost = 0.0;  ///< its walk_cost when it was built
};

/// What an update needs to know of the build before it.
struct GeometryPlan {
    std::vector<MeshPlan> meshes;
    std::vector<uint32_t> recorded;   ///< instances that have records, in their order
    std::vector<uint32_t> record_of;  ///< by instance, its place in `recorded`; NONE: baked or hidden
    uint32_t first_record = 0;
    uint32_t spare_node = 0;  ///< the first of those behind the table, for the top of the tree
    uint32_t spare_count = 0;
    uint32_t still_root = 0;  ///< node of the tree of all that is baked
    bool has_still = false;
    bool top_has_records_alone = false;  ///< nothing but records and that tree hang on the top
    glm::vec3 still_lower{0.0f};
    glm::vec3 still_upper{0.0f};
    glm::vec3 still_extent{0.0f};
    uint32_t top_stack = 0;  ///< entries that a walk through the top may need

    std::vector<std::vector<uint32_t>> baked_slots;  ///< by instance that is baked, the slot of each triangle
    std::vector<std::vector<uint32_t>> mesh_slots;   ///< by mesh that has a tree, the same

    /// The slot of a triangle that can be met.
    uint32_t slot_of(uint32_t instance, uint32_t mesh, uint32_t primitive) const {
        const std::vector<uint32_t>& baked = baked_slots[instance];
        return baked.empty() ? mesh_slots[mesh][primitive] : baked[primitive];
    }
};

/// The tables that follow from meshes and instances, ready for upload.
struct GeometryTables {
    std::vector<WideNode> nodes;
    std::vector<glm::vec4> triangles;
    std::vector<glm::uvec4> mesh_triangles;
    std::vector<glm::vec4> vertices;
    std::vector<glm::vec4> instances;
    glm::vec3 extent{0.0f};       ///< largest coordinate in magnitude, world space
    uint32_t features = 0;        ///< FEATURE_INSTANCES, FEATURE_ALPHA, ... as the triangles need them
    uint64_t triangle_count = 0;  ///< in all visible instances
    GeometryPlan plan;
};

/// The vertex_rows of a mesh, where they are.
struct RowsOfMesh {
    uint32_t mesh = 0;
};

/// Rows to be put into a table in place of those that are there.
struct TablePatch {
    uint32_t table = 0;
    uint64_t offset = 0;  ///< bytes
    std::variant<std::vector<WideNode>, std::vector<glm::vec4>, RowsOfMesh> rows;
};

/// The bytes of a patch. `meshes` as the update had them.
std::span<const std::byte> bytes_of(const TablePatch& patch, const std::vector<CoreMeshCopy>& meshes);

/// What an update changes.
struct GeometryUpdate {
    std::vector<TablePatch> patches;
    glm::vec3 extent{0.0f};
};

/// Opacity of a material on a mesh, as trace's triangle rows carry it.
using OpacityOf = std::function<float(uint32_t material, bool mesh_has_colors)>;

/// Bytes that a mesh takes in the tables at least, whatever the instances.
uint64_t least_bytes(uint64_t triangles, uint64_t vertex_rows);

/// Builds trees and tables. A mesh with one visible instance goes into the tree of the scene in world space; one with
/// several, or which moves, gets a tree of its own. Once something moves, all that is baked is a tree of its own too,
/// which hangs as a child on the top: so an update needs to build nothing but the top. `threads` 0: all. Fails with
/// invalid_argument where the scene has more triangles than the tables can count.
render_system::Result<GeometryTables> build_geometry(const std::vector<CoreMeshCopy>& meshes,
                                                     const std::vector<CoreInstance>& instances,
                                                     const OpacityOf& opacity_of, uint32_t threads,
                                                     const MovingParts& moving = {});

/// Brings what build_geometry made up to date where `moved` instances have other transforms and `deformed` meshes other
/// vertices: their own rows, their records, trees fitted again, and the top of the tree. A mesh's tree whose walk_cost
/// has grown to 1.4 times that of its build is built anew (the threshold of Lauterbach et al. 2006, "RT-DEFORM"). None
/// where that does not do: something that is baked has changed, or there is no room.
std::optional<GeometryUpdate> update_geometry(const std::vector<CoreMeshCopy>& meshes,
                                              const std::vector<CoreInstance>& instances,
                                              const std::vector<uint32_t>& moved, const std::vector<uint32_t>& deformed,
                                              const OpacityOf& opacity_of, uint32_t threads, GeometryPlan& plan);

}  // namespace source_core
