// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/core_geometry_parts.h"

#include <algorithm>

namespace source_core {

using render_system::CoreTransform;

namespace {

constexpr double PAD_SCALE = 1.0 / (1 << 21);  // as in trace.glsl
constexpr double BOX_SLACK = 1.0 / (1 << 20);  // for the rounding of transformed vertices

}  // namespace

Inverse invert(const CoreTransform& transform) {
    glm::dmat3 matrix;  // columns
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            matrix[c][r] = transform.rows[r][c];
        }
    }
    const double determinant = glm::determinant(matrix);
    Inverse result{{}, std::fabs(determinant) > 1e-30};
    const glm::dmat3 inverse = glm::inverse(matrix);
    for (int r = 0; r < 3; ++r) {
        double moved = 0.0;
        for (int c = 0; c < 3; ++c) {
            result.rows[r][c] = inverse[c][r];
            moved -= inverse[c][r] * transform.rows[c].w;
            result.usable = result.usable && std::fabs(inverse[c][r]) < 1e15;
        }
        result.rows[r][3] = moved;
        result.usable = result.usable && std::fabs(moved) < 1e15;
    }
    return result;
}

Box transform_box(const CoreTransform& transform, const Box& box) {
    Box result;
    for (int r = 0; r < 3; ++r) {
        double lower = transform.rows[r].w;
        double upper = lower;
        double reach = std::fabs(lower);
        for (int c = 0; c < 3; ++c) {
            const double a = static_cast<double>(transform.rows[r][c]) * box.lower[c];
            const double b = static_cast<double>(transform.rows[r][c]) * box.upper[c];
            lower += std::min(a, b);
            upper += std::max(a, b);
            reach += std::max(std::fabs(a), std::fabs(b));
        }
        result.lower[r] = static_cast<float>(lower - reach * BOX_SLACK);
        result.upper[r] = static_cast<float>(upper + reach * BOX_SLACK);
    }
    return result;
}

WideNode make_record(const Inverse& inverse, const Box& world, uint32_t root, uint32_t instance) {
    glm::vec4 rows[NODE_ROWS] = {};
    for (int r = 0; r < 3; ++r) {
        double pad = std::fabs(inverse.rows[r][3]);
        double growth = 0.0;
        for (int c = 0; c < 3; ++c) {
            const double size = std::fabs(inverse.rows[r][c]);
            pad += size * std::max(std::fabs(world.lower[c]), std::fabs(world.upper[c]));
            growth += size * 2.0;
            rows[r][c] = static_cast<float>(inverse.rows[r][c]);
        }
        rows[r].w = static_cast<float>(inverse.rows[r][3]);
        rows[RECORD_PAD][r] = static_cast<float>(pad * PAD_SCALE);
        rows[RECORD_INSTANCE][r] = static_cast<float>(growth * PAD_SCALE);
    }
    rows[RECORD_PAD].w = std::bit_cast<float>(root);
    rows[RECORD_INSTANCE].w = std::bit_cast<float>(instance);
    return std::bit_cast<WideNode>(rows);
}

void append_nodes(const std::vector<WideNode>& nodes, uint32_t first_node, uint32_t first_slot,
                  std::vector<WideNode>& table) {
    for (WideNode node : nodes) {
        for (uint32_t& word : node.children) {
            const uint32_t leaf_count = (word >> LEAF_COUNT_SHIFT) & LEAF_COUNT_MASK;
            if ((word & LEAF) == 0) {
                word += first_node;
            } else if (leaf_count != 0 && leaf_count != LEAF_INSTANCE) {
                word += first_slot;
            }
        }
        table.push_back(node);
    }
}

BuildPrimitive hanging(const Box& box, uint32_t number) { return {box.lower, number, box.upper, 1}; }

void name_hanging(std::vector<WideNode>& nodes, const GeometryPlan& plan) {
    for (WideNode& node : nodes) {
        for (uint32_t& word : node.children) {
            if ((word & LEAF) == 0 || ((word >> LEAF_COUNT_SHIFT) & LEAF_COUNT_MASK) != LEAF_INSTANCE) {
                continue;
            }
            const uint32_t number = word & LEAF_FIRST_MASK;
            const bool still = number == plan.recorded.size();
            word = still ? plan.still_root : LEAF | (LEAF_INSTANCE << LEAF_COUNT_SHIFT) | (plan.first_record + number);
        }
    }
}

glm::vec3 extent_of(const std::vector<BuildPrimitive>& primitives) {
    glm::vec3 extent(0.0f);
    for (const BuildPrimitive& primitive : primitives) {
        extent = glm::max(extent, glm::max(glm::abs(primitive.lower), glm::abs(primitive.upper)));
    }
    return extent;
}

}  // namespace source_core
