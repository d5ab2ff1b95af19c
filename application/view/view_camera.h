// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "render_system/camera.h"
#include "render_system/host_scene.h"

namespace application {

/// A camera that a person moves: an eye that looks at a point, y up. Lengths are in units of the scene.
class ViewCamera {
public:
    /// Looks as `camera` does, at a point as far off as the middle of `bounds`.
    ViewCamera(const render_system::Camera& camera, const render_system::Box& bounds);

    /// Around the point looked at, by radians; right and up are positive.
    void orbit(double right, double up);
    /// Around the eye, by radians.
    void look(double right, double up);
    /// Across, by shares of the picture's height: what stands at the distance of the point looked at goes along.
    void pan(double right, double up);
    /// Nearer (below 1) or farther.
    void zoom(double factor);
    /// Flies, by shares of the distance to the point looked at.
    void fly(double forward, double right, double up);
    /// So that all of the box is seen from where the eye looks.
    void frame(const render_system::Box& box, double aspect);

    /// The camera itself; until it is moved that which it was made of, to the bit.
    render_system::Camera camera() const;

private:
    glm::dvec3 forward() const;
    glm::dvec3 right() const;
    glm::dvec3 eye() const { return target_ - distance_ * forward(); }
    double seen_height() const;

    render_system::Camera made_of_;
    glm::dvec3 target_{0.0};
    double distance_ = 1.0, yaw_ = 0.0, pitch_ = 0.0;  // of the way to the target: about y from -z on, and above xz
    double nearest_ = 1e-4, farthest_ = 1e9;
    bool moved_ = false;
};

}  // namespace application
