// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace render_system {

struct HostMesh;

/// What one morph target adds, at weight 1: an array has an element a vertex, or none.
struct MorphTarget {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> tangents;
};

/// Triangles from `first` up to `end`.
struct TriangleRange {
    uint32_t first = 0;
    uint32_t end = 0;
};

/// The vertices of a mesh as they are before anything deforms it, and all that can.
struct RestMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;  ///< or none
    std::vector<TriangleRange> flat;  ///< triangles of vertices of their own, whose normals are made of their corners
    std::vector<MorphTarget> targets;
    uint32_t influences = 0;       ///< joints that can pull at a vertex: a multiple of 4; 0: no skin
    std::vector<uint16_t> joints;  ///< `influences` a vertex, into the list of matrices
    std::vector<float> weights;    ///< with them; of a vertex they add up to 1
};

/// Puts the deformed vertices into `mesh`, which has the triangles: first the morph targets, each by its weight (none
/// past the end counts), then the skin, by the weighted sum of its joints' matrices (glTF 2.0, 3.7.2.2 and 3.7.3).
/// Normals go by the matrix of cofactors, so that they stay on the side that the triangles' winding shows. With no
/// `matrices` the skin rests.
void deform(const RestMesh& rest, std::span<const double> weights, std::span<const glm::mat4> matrices, HostMesh& mesh);

/// The unit normal of a triangle by its winding; +z where it has no area. In double precision: small triangles far
/// from the origin keep a direction.
glm::vec3 flat_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

}  // namespace render_system
