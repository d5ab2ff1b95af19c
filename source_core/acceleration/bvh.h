// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "source_core/kernels/bindings.h"

namespace source_core {

/// What a tree is built over: a box with a number. One that stands alone gets a leaf of its own (an instance); all
/// others share leaves (triangles).
struct BuildPrimitive {
    glm::vec3 lower;
    uint32_t id;
    glm::vec3 upper;
    uint32_t alone;  // 0 or 1
};

/// A node as the kernels read it: NODE_ROWS rows. Boxes of empty children are points at 1e30.
struct WideNode {
    float bounds[6][4];  // lower x of the four children, upper x, lower y, upper y, lower z, upper z
    uint32_t children[4];
};
static_assert(sizeof(WideNode) == NODE_ROWS * 16);

struct WideTree {
    std::vector<WideNode> nodes;  // the root first; child words count from it
    std::vector<uint32_t> order;  // ids of the sharing primitives in the order of the leaves' slots
    uint32_t stack_need = 0;      // entries that a walk needs at most
};

/// Builds a 4-wide tree with the surface area heuristic over binned centroids. `stack_limit` bounds the walk's stack:
/// where the heuristic would need more, splits fall back to medians. The result does not depend on `threads` (0: all).
/// Leaves hold up to 4 triangles; those of a primitive that stands alone hold its id. Boxes must be finite.
WideTree build_wide_tree(std::vector<BuildPrimitive> primitives, uint32_t threads, uint32_t stack_limit);

/// Fits the boxes of a tree of triangles to where these are now: `rows` has TRIANGLE_ROWS for each in the order of
/// tree.order, as the table of triangles. Which node holds what stays.
void refit_wide_tree(WideTree& tree, std::span<const glm::vec4> rows);

/// What a walk through the tree is expected to cost: the half areas of all children over that of the root (Goldsmith
/// and Salmon 1987). It grows as primitives drift apart that were built into one node. 0 for an empty tree.
double walk_cost(const WideTree& tree);

}  // namespace source_core
