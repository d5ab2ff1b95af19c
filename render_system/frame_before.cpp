// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/frame_before.h"

#include <algorithm>
#include <glm/glm.hpp>

#include "render_system/scene_limits.h"

namespace render_system {
namespace {

/// In double precision: what is left of large transforms that nearly cancel is the motion.
glm::dmat4 matrix_of(const CoreTransform& transform) {
    return glm::transpose(glm::dmat4(transform.rows[0], transform.rows[1], transform.rows[2], glm::dvec4(0, 0, 0, 1)));
}

}  // namespace

std::vector<glm::vec4> motions_between(std::span<const CoreTransform> before, std::span<const CoreTransform> now) {
    const size_t known = std::min(before.size(), now.size());
    if (std::equal(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(known), now.begin())) return {};
    std::vector<glm::vec4> rows;
    rows.reserve(3 * now.size());
    for (size_t i = 0; i < now.size(); ++i) {
        CoreTransform motion;
        if (i < known && !(before[i] == now[i]) && is_invertible(now[i])) {
            const glm::dmat4 back = glm::transpose(matrix_of(before[i]) * glm::inverse(matrix_of(now[i])));
            for (int row = 0; row < 3; ++row) motion.rows[row] = glm::vec4(back[row]);
        }
        rows.insert(rows.end(), std::begin(motion.rows), std::end(motion.rows));
    }
    return rows;
}

}  // namespace render_system
