// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <span>
#include <vector>

#include "target_core/device/instance_geometry.h"

namespace target_core {

/// A triangle that shares its surface with another. Which of two such a ray meets is decided by the shared triangle
/// test, with ties to the lower (instance, primitive), as in the source core; Embree would take either.
struct SharedTriangle {
    uint instance = 0;
    uint primitive = 0;
};

/// Of a scene's box, in magnitude.
float largest_coordinate(RTCScene scene);

/// The triangles that have the same three corners in world space as another, to the bit and in any order: two things
/// in one place. Surfaces that are cut into triangles otherwise, or lie in one plane by chance, are not looked for.
std::vector<SharedTriangle> find_shared_triangles(std::span<const InstanceGeometry> geometry);

}  // namespace target_core
