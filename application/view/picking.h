// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "render_system/host_scene.h"
#include "render_system/ray_probe.h"

namespace application {

/// The ray through a place of a picture; `x` and `y` from its top left corner, 1 is its other side.
struct PictureRay {
    glm::dvec3 origin, direction;
};
PictureRay ray_through(const render_system::ViewPyramid& view, double x, double y);

/// What stands there.
struct Picked {
    uint32_t instance = 0;
    uint32_t material = 0;
    std::string node;  ///< the name of the node that carries the instance, or of its mesh
    std::string material_name;
    double distance = 0.0;  ///< from the eye, or, where rays are parallel, from the plane of the eye
};
std::optional<Picked> pick(const render_system::HostScene& scene, render_system::RayProbe& probe,
                           const render_system::ViewPyramid& view, double x, double y);

}  // namespace application
