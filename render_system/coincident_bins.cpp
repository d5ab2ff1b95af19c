// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/coincident_bins.h"

#include <algorithm>
#include <cmath>

#include "render_system/coincident_geometry.h"

namespace render_system::coincident {

namespace {

constexpr double kBinsPerTriangle = 16.0;
constexpr double kMostBins = 1u << 18;      // of all entries, but for two a triangle
constexpr double kMostBinTests = 1u << 24;  // of all triangles that lie on others, each in every bin
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

// Puts a triangle into the bins of an entry that it reaches into; `corners` are u and v, in bins.
void add_to_bins(const TriangleName& name, Polygon corners, CoincidentSurfaces::Entry& entry) {
    glm::dvec2 least(1e30), most(-1e30);
    for (int i = 0; i < corners.count; ++i) {
        least = glm::min(least, corners.p[i]);
        most = glm::max(most, corners.p[i]);
    }
    const double last = entry.side - 1.0;
    least = glm::clamp(glm::floor(least - kBinRoom), 0.0, last);
    most = glm::clamp(glm::floor(most + kBinRoom), 0.0, last);
    for (double y = least.y; y <= most.y; ++y) {
        for (double x = least.x; x <= most.x; ++x) {
            const glm::dvec2 bin(x, y);
            if (!reaches_into(corners, bin - kBinRoom, bin + (1.0 + kBinRoom))) continue;
            entry.bins[static_cast<size_t>(y) * entry.side + static_cast<size_t>(x)].push_back(name);
        }
    }
}

}  // namespace

double bins_for(size_t count, size_t entries) {
    const auto n = static_cast<double>(count);
    const double allowed = std::max(kMostBins / static_cast<double>(entries), 2.0 * n);
    const double affordable = kMostBinTests / (static_cast<double>(entries) * n);
    return std::max(1.0, std::floor(std::sqrt(std::min({kBinsPerTriangle * n, allowed, affordable}))));
}

CoincidentSurfaces::Entry entry_of(std::span<const PlacedMesh> scene, const TriangleName& triangle,
                                   const std::vector<TriangleName>& lower, double side) {
    const auto corners = [&](const TriangleName& name) { return corners_of(scene[name.instance], name.primitive); };
    CoincidentSurfaces::Entry entry{triangle, lower, static_cast<uint32_t>(side), {}};
    entry.bins.resize(size_t{entry.side} * entry.side);
    const TriangleFrame frame(corners(triangle));
    for (const TriangleName& name : lower) {
        Polygon in_bins;
        for (const glm::vec3& p : corners(name).p) in_bins.p[in_bins.count++] = frame.at(p) * side;
        add_to_bins(name, turned_left(in_bins), entry);
    }
    return entry;
}

}  // namespace render_system::coincident
