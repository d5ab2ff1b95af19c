// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/picking.h"

namespace application {

using render_system::HostScene;
using render_system::RayProbe;
using render_system::ViewPyramid;

PictureRay ray_through(const ViewPyramid& view, double x, double y) {
    const glm::dvec3 corner(view.top_left), across = glm::dvec3(view.top_right) - corner,
                                            down = glm::dvec3(view.bottom_left) - corner;
    const glm::dvec3 place = corner + x * across + y * down;
    if (!view.parallel) return {view.eye, glm::normalize(place - glm::dvec3(view.eye))};
    const glm::dvec3 middle = corner + 0.5 * (across + down);
    return {glm::dvec3(view.eye) + place - middle, glm::normalize(middle - glm::dvec3(view.eye))};
}

std::optional<Picked> pick(const HostScene& scene, RayProbe& probe, const ViewPyramid& view, double x, double y) {
    const PictureRay ray = ray_through(view, x, y);
    const auto hit = probe.first_hit(ray.origin, ray.direction);
    if (!hit) return std::nullopt;
    const auto& mesh = scene.meshes()[scene.instances()[hit->instance].mesh];
    Picked out;
    out.instance = hit->instance;
    out.material = mesh.triangles[hit->triangle].w;
    out.node = mesh.name;
    for (const auto& node : scene.nodes())
        if (node.instance == hit->instance && !node.name.empty()) out.node = node.name;
    out.material_name = scene.materials()[out.material].name;
    out.distance = hit->t;
    return out;
}

}  // namespace application
