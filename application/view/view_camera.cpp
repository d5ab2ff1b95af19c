// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/view_camera.h"

#include <algorithm>
#include <cmath>

namespace application {
namespace {

using render_system::Box;
using render_system::Camera;

constexpr double STEEPEST = 1.5690;  // short of straight up, where right is no direction any more

}  // namespace

ViewCamera::ViewCamera(const Camera& camera, const Box& bounds) : made_of_(camera) {
    const glm::dvec3 way(camera.forward), from(camera.position);
    const double radius =
        bounds.empty() ? 1.0 : std::max(1e-6, 0.5 * glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower)));
    nearest_ = radius * 1e-4;
    farthest_ = radius * 1e4;
    const double off = bounds.empty() ? 1.0 : glm::dot(glm::dvec3(bounds.center()) - from, way);
    distance_ = std::clamp(off, radius * 1e-2, farthest_);
    target_ = from + distance_ * way;
    pitch_ = std::clamp(std::asin(std::clamp(way.y, -1.0, 1.0)), -STEEPEST, STEEPEST);
    yaw_ = std::atan2(way.x, -way.z);
}

glm::dvec3 ViewCamera::forward() const {
    return {std::sin(yaw_) * std::cos(pitch_), std::sin(pitch_), -std::cos(yaw_) * std::cos(pitch_)};
}

glm::dvec3 ViewCamera::right() const { return {std::cos(yaw_), 0.0, std::sin(yaw_)}; }

double ViewCamera::seen_height() const {
    if (made_of_.parallel_height > 0.0f) return made_of_.parallel_height;
    return 2.0 * distance_ * std::tan(0.5 * static_cast<double>(made_of_.vertical_fov));
}

void ViewCamera::orbit(double right, double up) {
    moved_ = true;
    yaw_ = std::remainder(yaw_ - right, 2.0 * M_PI);
    pitch_ = std::clamp(pitch_ - up, -STEEPEST, STEEPEST);
}

void ViewCamera::look(double right, double up) {
    const glm::dvec3 from = eye();
    moved_ = true;
    yaw_ = std::remainder(yaw_ + right, 2.0 * M_PI);
    pitch_ = std::clamp(pitch_ + up, -STEEPEST, STEEPEST);
    target_ = from + distance_ * forward();
}

void ViewCamera::pan(double right, double up) {
    moved_ = true;
    const glm::dvec3 upwards = glm::cross(this->right(), forward());
    target_ -= seen_height() * (right * this->right() + up * upwards);
}

void ViewCamera::zoom(double factor) {
    moved_ = true;
    distance_ = std::clamp(distance_ * factor, nearest_, farthest_);
    made_of_.parallel_height *= static_cast<float>(factor);
}

void ViewCamera::fly(double forward, double right, double up) {
    moved_ = true;
    target_ += distance_ * (forward * this->forward() + right * this->right() + glm::dvec3(0.0, up, 0.0));
}

/// The sphere around the box fits the narrower of the two angles.
void ViewCamera::frame(const Box& box, double aspect) {
    if (box.empty()) return;
    moved_ = true;
    const double radius = std::max(0.5 * glm::length(glm::dvec3(box.upper) - glm::dvec3(box.lower)), nearest_);
    const double half_height = std::tan(0.5 * static_cast<double>(made_of_.vertical_fov));
    const double half_angle = std::atan(half_height * std::min(1.0, aspect));
    target_ = glm::dvec3(box.center());
    distance_ = std::clamp(radius / std::sin(half_angle), nearest_, farthest_);
    if (made_of_.parallel_height > 0.0f)
        made_of_.parallel_height = static_cast<float>(2.0 * radius / std::min(1.0, aspect));
}

Camera ViewCamera::camera() const {
    if (!moved_) return made_of_;
    Camera out = render_system::look_at(eye(), target_, {0.0f, 1.0f, 0.0f}, made_of_.vertical_fov);
    out.aperture = made_of_.aperture;
    out.parallel_height = made_of_.parallel_height;
    out.focus = made_of_.focus;
    return out;
}

}  // namespace application
