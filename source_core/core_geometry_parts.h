// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "source_core/core_geometry.h"

// What building the tables of the device's tree and bringing them up to date have in common.
namespace source_core {

constexpr float FARTHEST = 1.0e18f;  // triangles beyond cannot be hit: their products overflow
constexpr uint32_t MESH_STACK_LIMIT = 30;

struct Triangle {
    glm::vec3 vertices[3];
};

struct Box {
    glm::vec3 lower{FARTHEST};
    glm::vec3 upper{-FARTHEST};

    void include(const glm::vec3& p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
};

/// The inverse of a transform's matrix and where it takes the origin to; not usable where the matrix is singular.
struct Inverse {
    double rows[3][4];
    bool usable;
};

inline bool is_reachable(const Triangle& triangle) {
    for (const glm::vec3& p : triangle.vertices) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::fabs(p[axis]) < FARTHEST)) {
                return false;
            }
        }
    }
    return true;
}

/// A triangle of a mesh in its own space.
inline Triangle triangle_of(const CoreMeshCopy& mesh, uint32_t primitive) {
    const glm::uvec4& corners = mesh.triangles[primitive];
    return {{mesh.positions[corners.x], mesh.positions[corners.y], mesh.positions[corners.z]}};
}

inline BuildPrimitive primitive_of(const Triangle& triangle, uint32_t id) {
    Box box;
    for (const glm::vec3& p : triangle.vertices) {
        box.include(p);
    }
    return {box.lower, id, box.upper, 0};
}

Inverse invert(const render_system::CoreTransform& transform);

/// World-space box around the transformed box, with room for the rounding of its vertices.
Box transform_box(const render_system::CoreTransform& transform, const Box& box);

/// The node that stands for an instance: see RECORD_PAD in bindings.h.
WideNode make_record(const Inverse& inverse, const Box& world, uint32_t root, uint32_t instance);

/// Three rows of the table of triangles.
inline void append_slot(const Triangle& triangle, float opacity, uint32_t primitive, uint32_t instance,
                        std::vector<glm::vec4>& rows) {
    rows.push_back(glm::vec4(triangle.vertices[0], opacity));
    rows.push_back(glm::vec4(triangle.vertices[1], std::bit_cast<float>(primitive)));
    rows.push_back(glm::vec4(triangle.vertices[2], std::bit_cast<float>(instance)));
}

/// The nodes of a tree as they stand in the table: the tree's own from `first_node` on, its leaves from `first_slot`.
void append_nodes(const std::vector<WideNode>& nodes, uint32_t first_node, uint32_t first_slot,
                  std::vector<WideNode>& table);

/// What hangs on the top of the tree as an instance does, with the number of a record.
BuildPrimitive hanging(const Box& box, uint32_t number);

/// Turns the leaves of a tree that hang on it into words for records, or for the tree of what stands still.
void name_hanging(std::vector<WideNode>& nodes, const GeometryPlan& plan);

/// The largest coordinates in magnitude.
glm::vec3 extent_of(const std::vector<BuildPrimitive>& primitives);

}  // namespace source_core
