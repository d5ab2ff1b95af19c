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

/// The triangles of a native scene that have another of their own direction within 1e-5 of the scene's largest
/// coordinate, in order. Looked for at the middle of each triangle, and near the corners of those that are
/// longer than a hundredth of the scene: where neither of two lies on the other there, they are not found.
/// `scene` holds all of `geometry`, by Embree's own triangles. Call inside the task arena whose threads shall look.
std::vector<SharedTriangle> find_shared_triangles(RTCScene scene, std::span<const InstanceGeometry> geometry);

}  // namespace target_core
