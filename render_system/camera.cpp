// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/camera.h"

#include <cmath>

namespace render_system {

namespace {

// Double precision inside, so that a camera does not depend on the order of few-ulp operations at far-away positions.
glm::dvec3 perpendicular_to(const glm::dvec3& direction, const glm::dvec3& wish) {
    const glm::dvec3 candidates[] = {wish, {0, 1, 0}, {0, 0, -1}, {1, 0, 0}};
    for (const glm::dvec3& candidate : candidates) {
        const double size = glm::length(candidate);
        if (!(size > 0.0)) continue;
        const glm::dvec3 part = candidate / size - glm::dot(candidate / size, direction) * direction;
        if (glm::length(part) > 1e-6) return glm::normalize(part);
    }
    return {0, 1, 0};
}

}  // namespace

Camera look_at(const glm::vec3& position, const glm::vec3& target, const glm::vec3& up, float vertical_fov) {
    const glm::dvec3 way = glm::dvec3(target) - glm::dvec3(position);
    const glm::dvec3 forward = glm::length(way) > 0.0 ? glm::normalize(way) : glm::dvec3(0, 0, -1);
    const glm::dvec3 true_up = perpendicular_to(forward, up);
    Camera camera;
    camera.position = position;
    camera.forward = forward;
    camera.up = true_up;
    camera.right = glm::cross(forward, true_up);
    camera.vertical_fov = vertical_fov;
    return camera;
}

ViewPyramid view_pyramid(const Camera& camera, uint32_t width, uint32_t height) {
    const float half_height = static_cast<float>(std::tan(0.5 * static_cast<double>(camera.vertical_fov)));
    const float aspect = static_cast<float>(static_cast<double>(width) / static_cast<double>(height));
    const glm::vec3 across = camera.right * (half_height * aspect);
    const glm::vec3 upwards = camera.up * half_height;
    const glm::vec3 middle = camera.position + camera.forward;
    ViewPyramid view;
    view.eye = camera.position;
    view.top_left = middle - across + upwards;
    view.top_right = middle + across + upwards;
    view.bottom_left = middle - across - upwards;
    return view;
}

}  // namespace render_system
