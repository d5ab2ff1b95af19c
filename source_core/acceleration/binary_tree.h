// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "source_core/acceleration/bvh.h"

namespace source_core {

/// Node of the binary tree from which the wide one is made. Children are neighbours.
struct BinaryNode {
    glm::vec3 lower;
    uint32_t first;  // inner: the left child; leaf: the first primitive
    glm::vec3 upper;
    uint32_t count;  // 0: inner
};

float half_area(const BinaryNode& node);

/// Builds the binary tree over `primitives` (at least one) and sorts them by leaf. From `median_depth` on, splits are
/// medians. Node 0 is the root.
std::vector<BinaryNode> build_binary_tree(std::vector<BuildPrimitive>& primitives, uint32_t threads,
                                          uint32_t median_depth);

}  // namespace source_core
