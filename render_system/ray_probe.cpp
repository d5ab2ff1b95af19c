// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/ray_probe.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace render_system {

namespace {

constexpr uint32_t kLeaf = 4;
constexpr double kFarthest = std::numeric_limits<double>::infinity();

// The box of a mesh placed in the world, by its corners.
Box placed_box(const Box& box, const CoreTransform& transform) {
    Box result;
    for (int corner = 0; corner < 8 && !box.empty(); ++corner) {
        const glm::vec3 point(corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                              corner & 4 ? box.upper.z : box.lower.z);
        result.extend(transform_point(transform, point));
    }
    return result;
}

// Slabs; fmin and fmax pass over the NaN of a ray along a side. A box grown by what floats round.
bool meets(const Box& box, const glm::dvec3& origin, const glm::dvec3& inverse, double farthest) {
    double enter = 0.0, leave = farthest;
    for (int i = 0; i < 3; ++i) {
        const double lower = static_cast<double>(box.lower[i]), upper = static_cast<double>(box.upper[i]);
        const double pad = 1e-6 * std::max(std::abs(lower), std::abs(upper));
        const double a = (lower - pad - origin[i]) * inverse[i], b = (upper + pad - origin[i]) * inverse[i];
        enter = std::fmax(enter, std::fmin(a, b));
        leave = std::fmin(leave, std::fmax(a, b));
    }
    return enter <= leave;
}

// The share of rays that meet the surface.
double coverage_of(const CoreMaterial& material) {
    if (material.opaque) return 1.0;
    if (material.alpha_cutoff > 0.0f) return material.alpha >= material.alpha_cutoff ? 1.0 : 0.0;
    return static_cast<double>(material.alpha);
}

}  // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes) : order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!boxes.empty()) build(boxes, 0, static_cast<uint32_t>(boxes.size()));
}

void BoxTree::build(const std::vector<Box>& boxes, uint32_t first, uint32_t count) {
    Box bounds, centers;
    for (uint32_t i = first; i < first + count; ++i) {
        const Box& box = boxes[order_[i]];
        if (box.empty()) continue;
        bounds.extend(box.lower);
        bounds.extend(box.upper);
        centers.extend(box.center());
    }
    const size_t node = nodes_.size();
    nodes_.push_back({bounds});
    if (count <= kLeaf) return;
    const glm::vec3 size = centers.upper - centers.lower;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count,
                     [&](uint32_t a, uint32_t b) { return boxes[a].center()[axis] < boxes[b].center()[axis]; });
    build(boxes, first, count / 2);
    nodes_[node].second = static_cast<uint32_t>(nodes_.size());
    build(boxes, first + count / 2, count - count / 2);
}

template <class Visit>
void BoxTree::cross(const glm::dvec3& origin, const glm::dvec3& direction, const double& farthest,
                    Visit&& visit) const {
    if (nodes_.empty()) return;
    struct Entry {
        uint32_t node, first, count;
    };
    const glm::dvec3 inverse = 1.0 / direction;
    Entry stack[64];  // halves: 32 levels hold any count of 32 bits
    int depth = 0;
    stack[depth++] = {0, 0, static_cast<uint32_t>(order_.size())};
    while (depth > 0) {
        const Entry entry = stack[--depth];
        if (!meets(nodes_[entry.node].box, origin, inverse, farthest)) continue;
        if (entry.count <= kLeaf) {
            for (uint32_t i = 0; i < entry.count; ++i) visit(order_[entry.first + i]);
            continue;
        }
        const uint32_t half = entry.count / 2;
        stack[depth++] = {nodes_[entry.node].second, entry.first + half, entry.count - half};
        stack[depth++] = {entry.node + 1, entry.first, half};
    }
}

RayProbe::RayProbe(const HostScene& scene) : scene_(scene), meshes_(scene.meshes().size()) {
    std::vector<Box> boxes;
    for (uint32_t i = 0; i < scene.instances().size(); ++i) {
        const HostInstance& instance = scene.instances()[i];
        if (instance.mesh == NONE) continue;
        visible_.push_back(i);
        boxes.push_back(placed_box(scene.mesh_box(instance.mesh), instance.transform));
    }
    instances_.emplace(boxes);
}

const BoxTree& RayProbe::tree_of(uint32_t mesh) {
    if (meshes_[mesh]) return *meshes_[mesh];
    const HostMesh& source = scene_.meshes()[mesh];
    std::vector<Box> boxes(source.triangles.size());
    for (size_t i = 0; i < boxes.size(); ++i) {
        for (int corner = 0; corner < 3; ++corner) boxes[i].extend(source.positions[source.triangles[i][corner]]);
    }
    meshes_[mesh] = std::make_unique<BoxTree>(boxes);
    return *meshes_[mesh];
}

// Moller and Trumbore 1997, in the mesh's own space: t, u and v are the same there.
template <class Visit>
void RayProbe::cross_instance(uint32_t instance, const glm::dvec3& origin, const glm::dvec3& direction,
                              const double& farthest, Visit&& visit) {
    const HostInstance& placed = scene_.instances()[instance];
    const auto& rows = placed.transform.rows;
    const glm::dmat3 inverse =
        glm::inverse(glm::transpose(glm::dmat3(glm::dvec3(rows[0]), glm::dvec3(rows[1]), glm::dvec3(rows[2]))));
    const glm::dvec3 offset(rows[0].w, rows[1].w, rows[2].w);
    const glm::dvec3 from = inverse * (origin - offset), way = inverse * direction;
    const HostMesh& mesh = scene_.meshes()[placed.mesh];
    tree_of(placed.mesh).cross(from, way, farthest, [&](uint32_t number) {
        const glm::uvec4& triangle = mesh.triangles[number];
        const glm::dvec3 v0(mesh.positions[triangle.x]);
        const glm::dvec3 edge1 = glm::dvec3(mesh.positions[triangle.y]) - v0;
        const glm::dvec3 edge2 = glm::dvec3(mesh.positions[triangle.z]) - v0;
        const glm::dvec3 p = glm::cross(way, edge2);
        const double scale = 1.0 / glm::dot(edge1, p);
        const double u = glm::dot(from - v0, p) * scale;
        const glm::dvec3 q = glm::cross(from - v0, edge1);
        const double v = glm::dot(way, q) * scale, t = glm::dot(edge2, q) * scale;
        if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < farthest)) return;
        visit({instance, number, t, u, v}, coverage_of(scene_.materials()[triangle.w].core));
    });
}

std::optional<RayProbe::Hit> RayProbe::first_hit(const glm::dvec3& origin, const glm::dvec3& direction) {
    Hit best;
    best.t = kFarthest;
    instances_->cross(origin, direction, best.t, [&](uint32_t number) {
        cross_instance(visible_[number], origin, direction, best.t, [&](const Hit& hit, double coverage) {
            if (coverage >= 0.5) best = hit;
        });
    });
    return best.instance == NONE ? std::nullopt : std::optional(best);
}

double RayProbe::passage(const glm::dvec3& place, const glm::dvec3& other, const Hit& from) {
    constexpr double kEnds = 1e-4;  // of the way, at both ends
    double passed = 1.0, farthest = 1.0 - kEnds;
    const auto attenuate = [&](const Hit& hit, double coverage) {
        const bool own = hit.instance == from.instance && hit.triangle == from.triangle;
        if (!own && hit.t > kEnds) passed *= 1.0 - coverage;
        if (passed <= 0.0) farthest = 0.0;
    };
    instances_->cross(place, other - place, farthest, [&](uint32_t number) {
        cross_instance(visible_[number], place, other - place, farthest, attenuate);
    });
    return passed;
}

void RayProbe::vertices(const Hit& hit, glm::dvec3 (&corners)[3]) const {
    const HostInstance& instance = scene_.instances()[hit.instance];
    const HostMesh& mesh = scene_.meshes()[instance.mesh];
    const glm::uvec4& triangle = mesh.triangles[hit.triangle];
    for (int i = 0; i < 3; ++i)
        corners[i] = glm::dvec3(transform_point(instance.transform, mesh.positions[triangle[i]]));
}

}  // namespace render_system
