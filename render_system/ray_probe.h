// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "render_system/host_scene.h"

namespace render_system {

/// Boxes in a balanced binary tree, by the middle of their longest side: built in O(n log n), whatever the boxes.
class BoxTree {
public:
    explicit BoxTree(const std::vector<Box>& boxes);

    /// Calls visit(number of a box) for the boxes that the ray may cross before `farthest`, which visit may lower.
    template <class Visit>
    void cross(const glm::dvec3& origin, const glm::dvec3& direction, const double& farthest, Visit&& visit) const;

private:
    struct Node {
        Box box;
        uint32_t second = 0;  // child; the first follows the node
    };
    void build(const std::vector<Box>& boxes, uint32_t first, uint32_t count);

    std::vector<Node> nodes_;
    std::vector<uint32_t> order_;  // of the boxes, leaf after leaf
};

/// A few thousand rays against a host scene, for what the render system has to know itself. Trees are built for the
/// meshes that rays come near, when they do. Alpha counts by the material's factor, without its texture.
class RayProbe {
public:
    struct Hit {
        uint32_t instance = NONE;
        uint32_t triangle = NONE;
        double t = 0.0;  ///< in lengths of the direction
        double u = 0.0, v = 0.0;
    };

    /// The scene must stay as it is.
    explicit RayProbe(const HostScene& scene);

    /// The first surface that covers at least half.
    std::optional<Hit> first_hit(const glm::dvec3& origin, const glm::dvec3& direction);

    /// The share of light that all but the triangle `from` lets pass between both places.
    double passage(const glm::dvec3& place, const glm::dvec3& other, const Hit& from);

    /// The triangle's vertices in world space.
    void vertices(const Hit& hit, glm::dvec3 (&corners)[3]) const;

private:
    const BoxTree& tree_of(uint32_t mesh);
    /// Calls visit(hit, coverage) for each triangle of the instance that the ray crosses before `farthest`.
    template <class Visit>
    void cross_instance(uint32_t instance, const glm::dvec3& origin, const glm::dvec3& direction,
                        const double& farthest, Visit&& visit);

    const HostScene& scene_;
    std::vector<uint32_t> visible_;
    std::optional<BoxTree> instances_;
    std::vector<std::unique_ptr<BoxTree>> meshes_;
};

}  // namespace render_system
