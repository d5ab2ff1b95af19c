// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render_system/host_scene.h"

namespace render_system {

/// A unit vector perpendicular to `normal`.
glm::vec3 any_tangent(const glm::vec3& normal);

/// Gives the vertices from `first_vertex` on tangents made from the triangles from `first_triangle` on, as MikkTSpace
/// does (M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008): the direction of growing u in each
/// triangle, projected on the plane of the vertex normal, summed over corners that agree in position, normal, uv and
/// handedness, weighted by the corner's angle. Coordinates are those of `slot`, transform included. A vertex that
/// triangles of both handednesses share is split, so that `mesh` may grow. Corners without a direction (degenerate uv)
/// get any tangent. `mesh.tangents` must have one element per vertex. Answers which vertex each one that was added at
/// the end was split from.
std::vector<uint32_t> generate_tangents(HostMesh& mesh, size_t first_vertex, size_t first_triangle,
                                        const CoreTextureSlot& slot);

}  // namespace render_system
