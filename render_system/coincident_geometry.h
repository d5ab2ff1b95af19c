// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "render_system/coincident.h"

/// Triangles in world space and when two of them count as one place, for the search of coincident.h.
namespace render_system::coincident {

/// A triangle in world space.
struct Corners {
    glm::vec3 p[3];
};

/// The corners of a mesh's triangle by the arithmetic of the kernels' transform_point.
Corners corners_of(const PlacedMesh& mesh, uint32_t primitive);

/// Grown by what counts as one place. Boxes of what no ray meets hold nothing.
WorldBox box_of(const Corners& corners);
/// Around the boxes of all triangles, and maybe more: around vertices that none of them has.
WorldBox box_of(const PlacedMesh& mesh);
bool overlap(const WorldBox& a, const WorldBox& b);
void include(WorldBox& box, const WorldBox& other);

/// The same for the same three corners in any order, bit by bit.
using CornerBits = std::array<std::array<uint32_t, 3>, 3>;
CornerBits sorted_bits(const Corners& corners);

/// A convex polygon: two triangles cut each other to six corners at most.
struct Polygon {
    glm::dvec2 p[8];
    int count = 0;
};

/// What of a polygon is left of the line from a to b (Sutherland and Hodgman 1974).
Polygon cut(const Polygon& polygon, const glm::dvec2& a, const glm::dvec2& b);

/// A triangle whose corners go round to the left.
Polygon turned_left(Polygon triangle);

/// Whether two triangles lie in one plane, within 2^-18 of their largest coordinate, over a part that is more than a
/// line.
bool shares_surface(const Corners& a, const Corners& b);

}  // namespace render_system::coincident
