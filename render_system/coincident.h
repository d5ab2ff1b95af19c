// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace render_system {

/// A mesh where an instance has it.
struct PlacedMesh {
    const float* positions = nullptr;  ///< three a vertex
    uint32_t vertex_count = 0;
    const uint32_t* triangles = nullptr;   ///< four a triangle: three vertices, and one that is not looked at
    uint32_t triangle_count = 0;           ///< 0: hidden
    const glm::vec4* transform = nullptr;  ///< 3 rows from mesh to world space; null: positions are in world space
};

/// A triangle by the numbers that both cores know it by.
struct TriangleName {
    uint32_t instance = 0;
    uint32_t primitive = 0;  ///< in its mesh

    auto operator<=>(const TriangleName&) const = default;
};

/// Two triangles in one place.
struct CoincidentPair {
    TriangleName upper;
    TriangleName lower;
    bool same_corners = false;

    auto operator<=>(const CoincidentPair&) const = default;
};

/// A box in world space, empty at first.
struct WorldBox {
    glm::vec3 lower{1e30f};
    glm::vec3 upper{-1e30f};
};

/// Which triangles of a scene lie in one place: those of two instances whose planes agree over a part that is more than
/// a line, and those of one instance with the same three corners. A ray that meets one of them may be said to meet any
/// of them, by rounding alone; the kernels' lowest_in_place decides by what is found here, on the ray: the lowest
/// (instance, primitive) that the ray crosses nearer than half of what a ray is moved off a surface. Here those count
/// that are nearer than 2^-18 of their largest coordinate, so that all of these are among them.
///
/// Triangles are found by halving space until a cell holds one instance alone, or few triangles. Where very many lie
/// in one place the search ends after 256 comparisons for each triangle; what it has not found is left to rounding.
class CoincidentSurfaces {
public:
    /// Looks at the whole scene.
    void find(std::span<const PlacedMesh> scene);

    /// The same where of the scene of the last call only `changed` instances have moved or changed their shape: looks
    /// at these, and what is near them.
    void follow(std::span<const PlacedMesh> scene, std::span<const uint32_t> changed);

    bool empty() const { return pairs_.empty(); }

    /// A triangle and all in its place that are lower than it. Where these are many they are told apart by where on it
    /// they lie: bin (x, y) of side * side has those that reach into u from x / side and v from y / side on.
    struct Entry {
        TriangleName triangle;
        std::vector<TriangleName> lower;  ///< all of them, in order
        uint32_t side = 1;
        std::vector<std::vector<TriangleName>> bins;  ///< row by row, each in order
    };
    const std::vector<Entry>& entries() const { return entries_; }

private:
    void make_entries(std::span<const PlacedMesh> scene, const std::vector<bool>& changed);

    std::vector<CoincidentPair> pairs_;  // sorted
    std::vector<Entry> entries_;
    std::vector<WorldBox> boxes_;  // by instance, in world space, with room for what counts as one place
};

/// How a core refers to a triangle in its own tables.
struct CoincidentTriangle {
    uint32_t handle = 0;
    float opacity = 1.0f;  ///< as the core's opacity_code
};

/// The table `coincident` of the kernels, as layout.h of both cores describes it. Empty where there are no entries.
std::vector<glm::uvec4> pack_coincident(std::span<const CoincidentSurfaces::Entry> entries,
                                        const std::function<CoincidentTriangle(const TriangleName&)>& triangle_of);

}  // namespace render_system
