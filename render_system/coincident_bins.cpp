// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/coincident_bins.h"

#include <algorithm>
#include <cmath>

#include "render_system/coincident_geometry.h"

namespace render_system::coincident {

namespace {

// A bin is looked at by every ray that meets the triangle there, so that small things on a large one are worth many.
constexpr double kBinsPerTriangle = 64.0;
constexpr double kMostBins = 1u << 18;      // of all entries, but for two a triangle
constexpr double kTestsPerTriangle = 64.0;  // of triangles that lie on others, each in every bin around it
constexpr double kMostBinTests = 1u << 24;  // of all entries, but for one a triangle
constexpr double kBinRoom = 0.02;           // of a bin: for the rounding of u and v

// Where others lie on a triangle, in its u and v.
class TriangleFrame {
public:
    explicit TriangleFrame(const Corners& corners)
        : origin_(corners.p[0]), u_(glm::dvec3(corners.p[1]) - origin_), v_(glm::dvec3(corners.p[2]) - origin_) {
        uu_ = glm::dot(u_, u_);
        uv_ = glm::dot(u_, v_);
        vv_ = glm::dot(v_, v_);
    }

    glm::dvec2 at(const glm::vec3& p) const {
        const glm::dvec3 way = glm::dvec3(p) - origin_;
        const double u = glm::dot(way, u_), v = glm::dot(way, v_);
        return glm::dvec2(u * vv_ - v * uv_, v * uu_ - u * uv_) / (uu_ * vv_ - uv_ * uv_);
    }

private:
    glm::dvec3 origin_, u_, v_;
    double uu_, uv_, vv_;
};

// Whether a polygon reaches into a box.
bool reaches_into(Polygon polygon, const glm::dvec2& least, const glm::dvec2& most) {
    polygon = cut(polygon, least, {most.x, least.y});
    polygon = cut(polygon, {most.x, least.y}, most);
    polygon = cut(polygon, most, {least.x, most.y});
    return cut(polygon, {least.x, most.y}, least).count > 0;
}

// The bins around a triangle, whose corners are u and v.
struct BinRange {
    glm::dvec2 first, last;

    BinRange(const Polygon& corners, double side) {
        glm::dvec2 least(1e30), most(-1e30);
        for (int i = 0; i < corners.count; ++i) {
            least = glm::min(least, corners.p[i]);
            most = glm::max(most, corners.p[i]);
        }
        first = glm::clamp(glm::floor(least * side - kBinRoom), 0.0, side - 1.0);
        last = glm::clamp(glm::floor(most * side + kBinRoom), 0.0, side - 1.0);
    }
    double count() const { return (last.x - first.x + 1.0) * (last.y - first.y + 1.0); }
};

// Bins along a side: a power of two, so that the parts of which the kernels' filter knows are made of whole ones.
uint32_t side_for(const std::vector<Polygon>& lower, size_t pairs) {
    const auto count = static_cast<double>(lower.size()), all = static_cast<double>(pairs);
    const double bins = count * std::clamp(kMostBins / all, 2.0, kBinsPerTriangle);
    const double tests = count * std::clamp(kMostBinTests / all, 1.0, kTestsPerTriangle);
    const auto is_affordable = [&](double side) {
        double needed = 0.0;
        for (const Polygon& corners : lower) needed += BinRange(corners, side).count();
        return side * side <= bins && needed <= tests;
    };
    uint32_t side = 1;
    while (is_affordable(2.0 * side)) side *= 2;
    return side;
}

// Puts a triangle into the bins of an entry that it reaches into; `corners` are u and v.
void add_to_bins(const TriangleName& name, Polygon corners, CoincidentSurfaces::Entry& entry) {
    const BinRange range(corners, entry.side);
    for (int i = 0; i < corners.count; ++i) corners.p[i] *= static_cast<double>(entry.side);
    for (double y = range.first.y; y <= range.last.y; ++y) {
        for (double x = range.first.x; x <= range.last.x; ++x) {
            const glm::dvec2 bin(x, y);
            if (!reaches_into(corners, bin - kBinRoom, bin + (1.0 + kBinRoom))) continue;
            entry.bins[static_cast<size_t>(y) * entry.side + static_cast<size_t>(x)].push_back(name);
        }
    }
}

}  // namespace

CoincidentSurfaces::Entry entry_of(std::span<const PlacedMesh> scene, const TriangleName& triangle,
                                   const std::vector<TriangleName>& lower, size_t pairs) {
    const auto corners = [&](const TriangleName& name) { return corners_of(scene[name.instance], name.primitive); };
    const TriangleFrame frame(corners(triangle));
    std::vector<Polygon> placed;
    for (const TriangleName& name : lower) {
        Polygon on_triangle;
        for (const glm::vec3& p : corners(name).p) on_triangle.p[on_triangle.count++] = frame.at(p);
        placed.push_back(turned_left(on_triangle));
    }
    CoincidentSurfaces::Entry entry{triangle, lower, side_for(placed, pairs), {}};
    entry.bins.resize(size_t{entry.side} * entry.side);
    for (size_t i = 0; i < lower.size(); ++i) add_to_bins(lower[i], placed[i], entry);
    return entry;
}

}  // namespace render_system::coincident
