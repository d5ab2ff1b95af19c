// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/camera.h"

#include <algorithm>
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

// How far from the eye the screen stands. Far from the origin floats are wider apart than a screen at distance 1 is
// large, so that it moves away with the eye; a power of two changes no direction.
float screen_distance(const glm::vec3& eye) {
    constexpr float NEAR = 4096.0f, SHARE = 64.0f;
    const float reach = std::max(std::max(std::abs(eye.x), std::abs(eye.y)), std::abs(eye.z));
    return reach > NEAR && std::isfinite(reach) ? std::exp2(std::ceil(std::log2(reach / SHARE))) : 1.0f;
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
    const bool parallel = camera.parallel_height > 0.0f;
    const float half_height = static_cast<float>(std::tan(0.5 * static_cast<double>(camera.vertical_fov)));
    const float aspect = static_cast<float>(static_cast<double>(width) / static_cast<double>(height));
    // As far off as it is high, or rounding on it would turn parallel rays.
    const float distance = camera.aperture > 0.0f ? camera.focus
                           : parallel             ? std::max(camera.parallel_height, screen_distance(camera.position))
                                                  : screen_distance(camera.position);
    const float half_screen = parallel ? 0.5f * camera.parallel_height : half_height * distance;
    const glm::vec3 across = camera.right * (aspect * half_screen);
    const glm::vec3 upwards = camera.up * half_screen;
    const glm::vec3 middle = camera.position + camera.forward * distance;
    ViewPyramid view;
    view.eye = camera.position;
    view.top_left = middle - across + upwards;
    view.top_right = middle + across + upwards;
    view.bottom_left = middle - across - upwards;
    view.aperture = camera.aperture;
    view.parallel = parallel;
    return view;
}

Screen screen_of(const ViewPyramid& view, uint32_t height) {
    Screen screen;
    screen.corner = view.top_left - view.eye;
    screen.right = view.top_right - view.top_left;
    screen.down = view.bottom_left - view.top_left;
    const float distance = glm::length(screen.corner + 0.5f * (screen.right + screen.down));
    screen.pixel_angle = glm::length(screen.down) / (static_cast<float>(height) * std::max(distance, 1.0e-30f));
    if (view.parallel) {
        screen.parallel_pixel = glm::length(screen.down) / static_cast<float>(height);
        screen.pixel_angle = 0.0f;
    }
    if (view.aperture > 0.0f) {
        screen.lens_right = screen.right * (view.aperture / std::max(glm::length(screen.right), 1.0e-30f));
        screen.lens_down = screen.down * (view.aperture / std::max(glm::length(screen.down), 1.0e-30f));
    }
    return screen;
}

}  // namespace render_system
