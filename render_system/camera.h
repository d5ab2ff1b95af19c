// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "render_system/core_data.h"

namespace render_system {

/// A camera with a pinhole or a thin lens. The three directions are of unit length and perpendicular; right x up =
/// -forward.
struct Camera {
    glm::vec3 position{0.0f, 0.0f, 0.0f};
    glm::vec3 right{1.0f, 0.0f, 0.0f};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    glm::vec3 forward{0.0f, 0.0f, -1.0f};
    float vertical_fov = 0.6981317f;  ///< full angle, radians
    float aperture = 0.0f;            ///< radius of the lens; 0: a pinhole
    float parallel_height = 0.0f;     ///< orthographic: the height of what is seen; 0: by perspective
    float focus = 1.0f;               ///< with a lens: along `forward`, how far off pictures are sharp
};

/// A camera at `position` that looks at `target`. Falls back to another up where `up` is parallel to the view, and to
/// -z where target and position coincide.
Camera look_at(const glm::vec3& position, const glm::vec3& target, const glm::vec3& up, float vertical_fov);

/// The screen of `camera` for a picture of width x height pixels: the vertical field of view is kept, the aspect
/// follows the size. It stands at the focus of a lens; without one at distance 1, farther off where the eye is so far
/// from the origin that floats would blur it.
ViewPyramid view_pyramid(const Camera& camera, uint32_t width, uint32_t height);

/// A screen as camera rays are made from it.
struct Screen {
    glm::vec3 corner{0.0f};       ///< the top left one, seen from the eye
    glm::vec3 right{0.0f};        ///< from there to the top right
    glm::vec3 down{0.0f};         ///< from there to the bottom left
    float pixel_angle = 0.0f;     ///< of one pixel in the middle, radians: how fast ray cones grow
    glm::vec3 lens_right{0.0f};   ///< the lens's radius, along `right`
    glm::vec3 lens_down{0.0f};    ///< and along `down`
    float parallel_pixel = 0.0f;  ///< height of a pixel where all rays are parallel, else 0
};

Screen screen_of(const ViewPyramid& view, uint32_t height);

}  // namespace render_system
