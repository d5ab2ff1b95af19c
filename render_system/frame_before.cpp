// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/frame_before.h"

#include <algorithm>
#include <bit>
#include <glm/glm.hpp>

#include "render_system/scene_limits.h"

namespace render_system {
namespace {

/// In double precision: what is left of large transforms that nearly cancel is the motion.
glm::dmat4 matrix_of(const CoreTransform& transform) {
    return glm::transpose(glm::dmat4(transform.rows[0], transform.rows[1], transform.rows[2], glm::dvec4(0, 0, 0, 1)));
}

CoreTransform way_back(const CoreTransform& before, const CoreTransform& now) {
    CoreTransform motion;
    if (before == now || !is_invertible(now)) return motion;
    const glm::dmat4 back = glm::transpose(matrix_of(before) * glm::inverse(matrix_of(now)));
    for (int row = 0; row < 3; ++row) motion.rows[row] = glm::vec4(back[row]);
    return motion;
}

// Of each mesh that has an instance, the row of its first vertex behind those of all instances.
std::map<uint32_t, uint32_t> first_rows(std::span<const PlacedInstance> now, const ShapesBefore& shapes) {
    std::map<uint32_t, uint32_t> rows;
    size_t next = kMotionRows * now.size();
    for (const auto& [mesh, vertices] : shapes) {
        const bool is_placed =
            std::any_of(now.begin(), now.end(), [mesh = mesh](const PlacedInstance& i) { return i.mesh == mesh; });
        if (vertices.empty() || !is_placed) continue;
        rows[mesh] = static_cast<uint32_t>(next);
        next += vertices.size();
    }
    return rows;
}

}  // namespace

std::vector<glm::vec4> motions_between(std::span<const PlacedInstance> before, std::span<const PlacedInstance> now,
                                       const ShapesBefore& shapes) {
    const size_t known = std::min(before.size(), now.size());
    const std::map<uint32_t, uint32_t> first = first_rows(now, shapes);
    const auto stands = [](const PlacedInstance& a, const PlacedInstance& b) { return a.transform == b.transform; };
    if (first.empty() &&
        std::equal(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(known), now.begin(), stands))
        return {};
    std::vector<glm::vec4> rows;
    rows.reserve(kMotionRows * now.size());
    for (size_t i = 0; i < now.size(); ++i) {
        CoreTransform motion;
        uint32_t first_vertex = 0;
        if (i < known) {
            const auto shape = before[i].mesh == now[i].mesh ? first.find(now[i].mesh) : first.end();
            if (shape != first.end()) first_vertex = shape->second;
            motion = first_vertex > 0 ? before[i].transform : way_back(before[i].transform, now[i].transform);
        }
        rows.insert(rows.end(), std::begin(motion.rows), std::end(motion.rows));
        rows.emplace_back(std::bit_cast<float>(first_vertex), 0.0f, 0.0f, 0.0f);
    }
    for (const auto& [mesh, row] : first)
        for (const glm::vec3& vertex : shapes.at(mesh)) rows.emplace_back(vertex, 0.0f);
    return rows;
}

}  // namespace render_system
