// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "render_system/core_data.h"

namespace render_system {

/// What a temporal filter knows of the frame that was filtered before the one at hand.
struct FrameBefore {
    uint32_t frame = 0;  ///< which one of its history this is; 1: the first, and nothing below is of use; 0: no history
    bool is_same = false;  ///< neither view nor scene have changed since
    ViewPyramid view;
    std::vector<glm::vec4> motions;  ///< as motions_between; empty where no instance moved
};

/// For each instance, three rows of the matrix that takes a point of it from where it is to where it was; instances
/// that were not there, or are flattened now, count as unmoved. Empty where none moved.
std::vector<glm::vec4> motions_between(std::span<const CoreTransform> before, std::span<const CoreTransform> now);

}  // namespace render_system
