// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "render_system/core_data.h"
#include "render_system/status.h"
#include "source_core/acceleration/bvh.h"

namespace source_core {

/// A mesh as the core keeps it: what the tree is built from, and its rows of the tables.
struct CoreMeshCopy {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec4> triangles;
    std::vector<glm::vec4> vertex_rows;
    std::vector<uint32_t> tangents;
    bool has_tangents = false;
    bool has_colors = false;
};

struct CoreInstance {
    uint32_t mesh = render_system::NONE;  // NONE: hidden
    render_system::CoreTransform transform;
};

/// The tables that follow from meshes and instances, ready for upload.
struct GeometryTables {
    std::vector<WideNode> nodes;
    std::vector<glm::vec4> triangles;
    std::vector<glm::uvec4> mesh_triangles;
    std::vector<glm::vec4> vertices;
    std::vector<uint32_t> tangents;
    std::vector<glm::vec4> instances;
    glm::vec3 extent{0.0f};       ///< largest coordinate in magnitude, world space
    uint32_t features = 0;        ///< FEATURE_INSTANCES, FEATURE_ALPHA, ... as the triangles need them
    uint64_t triangle_count = 0;  ///< in all visible instances
};

/// Opacity of a material on a mesh, as trace's triangle rows carry it.
using OpacityOf = std::function<float(uint32_t material, bool mesh_has_colors)>;

/// Bytes that a mesh takes in the tables at least, whatever the instances.
uint64_t least_bytes(uint64_t triangles, uint64_t vertices);

/// Builds trees and tables. A mesh with one visible instance goes into the tree of the scene in world space; one with
/// several gets a tree of its own. `threads` 0: all. Fails with invalid_argument where the scene has more triangles
/// than the tables can count.
render_system::Result<GeometryTables> build_geometry(const std::vector<CoreMeshCopy>& meshes,
                                                     const std::vector<CoreInstance>& instances,
                                                     const OpacityOf& opacity_of, uint32_t threads);

}  // namespace source_core
