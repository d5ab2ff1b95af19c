// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <span>
#include <vector>

#include "render_system/core_data.h"

namespace render_system {

/// What a temporal filter knows of the frame that was filtered before the one at hand.
struct FrameBefore {
    uint32_t frame = 0;  ///< which one of its history this is; 1: the first, and nothing below is of use; 0: no history
    bool is_same = false;  ///< neither view nor scene have changed since
    ViewPyramid view;
    std::vector<glm::vec4> motions;  ///< as motions_between; empty where nothing moved
    bool shapes_changed = false;     ///< motions holds vertices
};

/// Where the vertices of meshes were that have changed their shape since, each in the space of its mesh.
using ShapesBefore = std::map<uint32_t, std::vector<glm::vec3>>;

struct PlacedInstance {
    uint32_t mesh = NONE;  ///< NONE: hidden
    CoreTransform transform;
};

constexpr size_t kMotionRows = 4;  ///< of an instance, in motions_between

/// For each instance four rows: three of a matrix and one that says of what, then vertices. Of an instance whose mesh
/// is among `shapes` it is the matrix that placed it before, and the fourth row has, as bits in x, the row of the first
/// of its vertices as they were. Of others it takes a point from where it is to where it was, and the fourth row is 0;
/// instances that were not there, or are flattened now, count as unmoved. Empty where nothing moved.
std::vector<glm::vec4> motions_between(std::span<const PlacedInstance> before, std::span<const PlacedInstance> now,
                                       const ShapesBefore& shapes);

}  // namespace render_system
