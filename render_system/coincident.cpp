// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/coincident.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace render_system {

namespace {

constexpr float kNear = 1.0f / (1 << 18);  // of the largest coordinate
constexpr float kOutOfReach = 1.0e18f;     // beyond, cores meet nothing
constexpr size_t kFew = 8;                 // parts of a leaf; neighbours of an instance that are told apart
constexpr int kDeepest = 48;               // halvings by the mean
constexpr size_t kMostParts = 1u << 25;    // triangles near those of others, 32 bytes each
// What a search may cost in comparisons before it gives up.
constexpr uint64_t kWorkPerTriangle = 256;
constexpr uint64_t kLeastWork = 1u << 24;

struct Corners {
    glm::vec3 p[3];
};

// The arithmetic of the kernels' transform_point.
glm::vec3 world_position(const PlacedMesh& mesh, uint32_t vertex) {
    const float* at = mesh.positions + size_t{vertex} * 3;
    const glm::vec3 p(at[0], at[1], at[2]);
    if (!mesh.transform) return p;
    const glm::vec4* rows = mesh.transform;
    return {((rows[0].x * p.x + rows[0].y * p.y) + rows[0].z * p.z) + rows[0].w,
            ((rows[1].x * p.x + rows[1].y * p.y) + rows[1].z * p.z) + rows[1].w,
            ((rows[2].x * p.x + rows[2].y * p.y) + rows[2].z * p.z) + rows[2].w};
}

Corners corners_of(const PlacedMesh& mesh, uint32_t primitive) {
    const uint32_t* vertices = mesh.triangles + size_t{primitive} * 4;
    return {{world_position(mesh, vertices[0]), world_position(mesh, vertices[1]), world_position(mesh, vertices[2])}};
}

float reach_of(const Corners& corners) {
    float reach = 0.0f;
    for (const glm::vec3& p : corners.p) {
        reach = std::max({reach, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
    return reach;
}

// Grown by what counts as one place. Boxes of what no ray meets hold nothing.
WorldBox box_of(const Corners& corners) {
    const float reach = reach_of(corners);
    if (!(reach < kOutOfReach)) return {};
    const glm::vec3 room(reach * kNear);
    return {glm::min(glm::min(corners.p[0], corners.p[1]), corners.p[2]) - room,
            glm::max(glm::max(corners.p[0], corners.p[1]), corners.p[2]) + room};
}

bool overlap(const WorldBox& a, const WorldBox& b) {
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
           a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

void include(WorldBox& box, const WorldBox& other) {
    box.lower = glm::min(box.lower, other.lower);
    box.upper = glm::max(box.upper, other.upper);
}

WorldBox box_of(const PlacedMesh& mesh) {
    WorldBox box;
    for (uint32_t i = 0; i < mesh.triangle_count; ++i) include(box, box_of(corners_of(mesh, i)));
    return box;
}

// The same for the same three corners in any order.
using CornerBits = std::array<std::array<uint32_t, 3>, 3>;

CornerBits sorted_bits(const Corners& corners) {
    CornerBits bits;
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec3& p = corners.p[i];
        const auto bits_of = [](float x) { return std::bit_cast<uint32_t>(x + 0.0f); };  // -0 is 0
        bits[i] = {bits_of(p.x), bits_of(p.y), bits_of(p.z)};
    }
    std::sort(bits.begin(), bits.end());
    return bits;
}

// A convex polygon: two triangles cut each other to six corners at most.
struct Polygon {
    glm::dvec2 p[8];
    int count = 0;
};

// What of a polygon is left of the line from a to b (Sutherland and Hodgman 1974).
Polygon cut(const Polygon& polygon, const glm::dvec2& a, const glm::dvec2& b) {
    const auto side = [&](const glm::dvec2& p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
    Polygon left;
    for (int i = 0; i < polygon.count; ++i) {
        const glm::dvec2& from = polygon.p[i];
        const glm::dvec2& to = polygon.p[(i + 1) % polygon.count];
        const double s = side(from), t = side(to);
        if (s >= 0.0) left.p[left.count++] = from;
        if ((s < 0.0) != (t < 0.0)) left.p[left.count++] = from + (to - from) * (s / (s - t));
    }
    return left;
}

// A plane as a height over two axes.
struct Plane {
    glm::dvec3 normal;  // not of unit length
    double distance;

    explicit Plane(const Corners& corners)
        : normal(glm::cross(glm::dvec3(corners.p[1]) - glm::dvec3(corners.p[0]),
                            glm::dvec3(corners.p[2]) - glm::dvec3(corners.p[0]))),
          distance(glm::dot(normal, glm::dvec3(corners.p[0]))) {}
    double height(const glm::dvec2& at, int axis, int u, int v) const {
        return (distance - normal[u] * at.x - normal[v] * at.y) / normal[axis];
    }
};

// A triangle whose corners go round to the left.
Polygon turned_left(Polygon triangle) {
    const glm::dvec2 a = triangle.p[1] - triangle.p[0], b = triangle.p[2] - triangle.p[0];
    if (a.x * b.y - a.y * b.x < 0.0) std::swap(triangle.p[1], triangle.p[2]);
    return triangle;
}

Polygon flattened(const Corners& corners, int u, int v) {
    Polygon polygon;
    for (const glm::vec3& p : corners.p) polygon.p[polygon.count++] = {p[u], p[v]};
    return turned_left(polygon);
}

// Twice the area over the length around.
double width_of(const Polygon& polygon) {
    double doubled = 0.0, around = 0.0;
    for (int i = 0; i < polygon.count; ++i) {
        const glm::dvec2& p = polygon.p[i];
        const glm::dvec2& q = polygon.p[(i + 1) % polygon.count];
        doubled += p.x * q.y - p.y * q.x;
        around += glm::length(q - p);
    }
    return around > 0.0 ? doubled / around : 0.0;
}

// Whether all of `corners` are farther than `near` from a plane, on one side of it.
bool passes_by(const Plane& plane, double length, const Corners& corners, double near) {
    int above = 0, below = 0;
    for (const glm::vec3& p : corners.p) {
        const double height = (glm::dot(plane.normal, glm::dvec3(p)) - plane.distance) / length;
        above += height > near ? 1 : 0;
        below += height < -near ? 1 : 0;
    }
    return above == 3 || below == 3;
}

bool shares_surface(const Corners& a, const Corners& b) {
    const double near = static_cast<double>(std::max(reach_of(a), reach_of(b))) * static_cast<double>(kNear);
    const Plane plane_a(a), plane_b(b);
    const double length_a = glm::length(plane_a.normal), length_b = glm::length(plane_b.normal);
    if (!(length_a > 0.0) || !(length_b > 0.0)) return false;
    if (std::fabs(glm::dot(plane_a.normal, plane_b.normal)) < 0.9 * length_a * length_b) return false;
    if (passes_by(plane_a, length_a, b, near)) return false;
    const glm::dvec3 size = glm::abs(plane_a.normal);
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Polygon common = flattened(b, u, v);
    const Polygon frame = flattened(a, u, v);
    for (int i = 0; i < 3 && common.count > 0; ++i) common = cut(common, frame.p[i], frame.p[(i + 1) % 3]);
    if (width_of(common) < near) return false;
    const double slant = size[axis] / length_a;
    return std::all_of(common.p, common.p + common.count, [&](const glm::dvec2& p) {
        return std::fabs(plane_a.height(p, axis, u, v) - plane_b.height(p, axis, u, v)) * slant <= near;
    });
}

struct Part {
    WorldBox box;
    TriangleName name;
};

// A tree over parts of space, made as far as a join asks for it: where one instance is alone nothing is sorted.
class PartTree {
public:
    // Pairs with a `wanted` instance are looked for; empty: all.
    PartTree(std::vector<Part> parts, const std::vector<bool>& wanted) : parts_(std::move(parts)), wanted_(wanted) {
        if (!parts_.empty()) nodes_.push_back(node_of(0, static_cast<uint32_t>(parts_.size())));
    }

    // Calls visit(a, b) once for any two parts of different instances, one of them wanted, whose boxes overlap; visits
    // no more when `work`, in comparisons, is used up. Where many parts have the same middle, thin(parts) puts those
    // first that have to stay, and says how many these are.
    template <class Visit, class Thin>
    void join(uint64_t& work, const Visit& visit, const Thin& thin) {
        if (!nodes_.empty()) join_within(0, work, visit, thin);
    }

private:
    static constexpr uint32_t kSeveral = ~0u;

    struct Node {
        WorldBox box;
        uint32_t first = 0;
        uint32_t count = 0;
        uint32_t low = 0;              // the high half follows it; 0: not halved
        uint32_t instance = kSeveral;  // of all parts
        uint16_t depth = 0;
        bool wanted = false;   // some part is
        bool is_leaf = false;  // cannot be halved
    };

    bool is_wanted(uint32_t instance) const { return wanted_.empty() || wanted_[instance]; }

    Node node_of(uint32_t first, uint32_t count) const {
        Node node;
        node.first = first;
        node.count = count;
        node.instance = parts_[first].name.instance;
        node.is_leaf = count <= kFew;
        for (uint32_t i = first; i < first + count; ++i) {
            include(node.box, parts_[i].box);
            if (parts_[i].name.instance != node.instance) node.instance = kSeveral;
            node.wanted = node.wanted || is_wanted(parts_[i].name.instance);
        }
        return node;
    }

    static glm::vec3 middle_of(const Part& part) { return part.box.lower * 0.5f + part.box.upper * 0.5f; }

    // How many of a node's parts its low half has, once they are sorted so; all or none: they have the same middle.
    uint32_t halve(const Node& node) {
        const std::span<Part> parts = std::span(parts_).subspan(node.first, node.count);
        WorldBox middles;
        glm::dvec3 sum(0.0);
        for (const Part& part : parts) {
            const glm::vec3 middle = middle_of(part);
            include(middles, {middle, middle});
            sum += middle;
        }
        const glm::vec3 size = middles.upper - middles.lower;
        const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        if (node.depth >= kDeepest && size[axis] > 0.0f) {
            std::nth_element(parts.begin(), parts.begin() + node.count / 2, parts.end(),
                             [axis](const Part& a, const Part& b) { return middle_of(a)[axis] < middle_of(b)[axis]; });
            return node.count / 2;
        }
        const auto mean = static_cast<float>(sum[axis] / node.count);
        const auto high =
            std::partition(parts.begin(), parts.end(), [&](const Part& part) { return middle_of(part)[axis] < mean; });
        return static_cast<uint32_t>(high - parts.begin());
    }

    // Halves a node, if that can be. Whether it has halves.
    template <class Thin>
    bool open(uint32_t number, const Thin& thin) {
        Node& node = nodes_[number];
        if (node.low != 0 || node.is_leaf) return node.low != 0;
        const uint32_t low = halve(node);
        if (low == 0 || low == node.count) {
            node.is_leaf = true;
            node.count = static_cast<uint32_t>(thin(std::span(parts_).subspan(node.first, node.count)));
            return false;
        }
        Node halves[2] = {node_of(node.first, low), node_of(node.first + low, node.count - low)};
        for (Node& half : halves) half.depth = static_cast<uint16_t>(node.depth + 1);
        node.low = static_cast<uint32_t>(nodes_.size());
        nodes_.insert(nodes_.end(), std::begin(halves), std::end(halves));
        return true;
    }

    template <class Visit, class Thin>
    void join_within(uint32_t number, uint64_t& work, const Visit& visit, const Thin& thin) {
        if (nodes_[number].instance != kSeveral || !nodes_[number].wanted || work == 0) return;
        const bool halved = open(number, thin);
        const Node node = nodes_[number];
        if (halved) {
            join_within(node.low, work, visit, thin);
            join_within(node.low + 1, work, visit, thin);
            join_across(node.low, node.low + 1, work, visit, thin);
        } else {
            for (uint32_t i = 0; i < node.count; ++i)
                visit_pairs(node.first + i, node.first + i + 1, node, work, visit);
        }
    }

    template <class Visit, class Thin>
    void join_across(uint32_t a, uint32_t b, uint64_t& work, const Visit& visit, const Thin& thin) {
        const auto extent = [&](uint32_t number) {
            const glm::vec3 size = nodes_[number].box.upper - nodes_[number].box.lower;
            return glm::dot(size, size);
        };
        const bool same = nodes_[a].instance != kSeveral && nodes_[a].instance == nodes_[b].instance;
        const bool wanted = nodes_[a].wanted || nodes_[b].wanted;
        if (work == 0 || same || !wanted || !overlap(nodes_[a].box, nodes_[b].box)) return;
        --work;
        if (nodes_[b].is_leaf || (!nodes_[a].is_leaf && extent(a) > extent(b))) std::swap(a, b);
        if (open(b, thin)) {
            const uint32_t low = nodes_[b].low;
            join_across(a, low, work, visit, thin);
            join_across(a, low + 1, work, visit, thin);
        } else if (!nodes_[a].is_leaf) {
            join_across(b, a, work, visit, thin);
        } else {
            const Node one = nodes_[a];
            for (uint32_t i = 0; i < one.count; ++i)
                visit_pairs(one.first + i, nodes_[b].first, nodes_[b], work, visit);
        }
    }

    // One part with those of a leaf from `from` on.
    template <class Visit>
    void visit_pairs(uint32_t part, uint32_t from, const Node& leaf, uint64_t& work, const Visit& visit) const {
        const Part& a = parts_[part];
        work -= std::min<uint64_t>(work, leaf.count);
        for (uint32_t i = from; i < leaf.first + leaf.count && work > 0; ++i) {
            const Part& b = parts_[i];
            if (a.name.instance == b.name.instance || !overlap(a.box, b.box)) continue;
            if (is_wanted(a.name.instance) || is_wanted(b.name.instance)) visit(a, b);
        }
    }

    std::vector<Part> parts_;
    const std::vector<bool>& wanted_;  // by instance
    std::vector<Node> nodes_;
};

// Finds pairs of triangles of different instances.
class PairSearch {
public:
    PairSearch(std::span<const PlacedMesh> scene, const std::vector<WorldBox>& boxes, const std::vector<bool>& wanted,
               std::vector<CoincidentPair>& pairs)
        : scene_(scene), boxes_(boxes), wanted_(wanted), pairs_(pairs) {}

    void run() {
        std::vector<Part> parts = triangles_near_others();
        uint64_t work = std::max(kLeastWork, kWorkPerTriangle * parts.size());
        PartTree tree(std::move(parts), wanted_);
        tree.join(
            work, [this](const Part& a, const Part& b) { compare(a, b); },
            [this](std::span<Part> same) { return without_copies(same); });
    }

private:
    Corners corners(const TriangleName& name) const { return corners_of(scene_[name.instance], name.primitive); }

    // By instance, the boxes of those that it reaches into; where these are many, its own.
    std::vector<std::vector<WorldBox>> neighbours() const {
        std::vector<Part> parts;
        for (uint32_t i = 0; i < scene_.size(); ++i) {
            if (scene_[i].triangle_count > 0) parts.push_back({boxes_[i], {i, 0}});
        }
        uint64_t work = std::max(kLeastWork, kWorkPerTriangle * parts.size());
        std::vector<std::vector<WorldBox>> near(scene_.size());
        const auto add = [&](uint32_t instance, uint32_t other) {
            std::vector<WorldBox>& boxes = near[instance];
            boxes.push_back(boxes_[other]);
            if (boxes.size() > kFew) boxes = {boxes_[instance]};
        };
        PartTree tree(std::move(parts), wanted_);
        tree.join(
            work,
            [&](const Part& a, const Part& b) {
                add(a.name.instance, b.name.instance);
                add(b.name.instance, a.name.instance);
            },
            [](std::span<Part> same) { return same.size(); });
        return near;
    }

    std::vector<Part> triangles_near_others() const {
        const std::vector<std::vector<WorldBox>> near = neighbours();
        std::vector<Part> parts;
        for (uint32_t instance = 0; instance < scene_.size(); ++instance) {
            const std::vector<WorldBox>& others = near[instance];
            for (uint32_t i = 0; i < scene_[instance].triangle_count && !others.empty(); ++i) {
                const WorldBox box = box_of(corners({instance, i}));
                const auto meets = [&](const WorldBox& other) { return overlap(box, other); };
                if (!std::any_of(others.begin(), others.end(), meets)) continue;
                if (parts.size() == kMostParts) return parts;
                parts.push_back({box, {instance, i}});
            }
        }
        return parts;
    }

    // Many things in one place: of those with the same corners the lowest stands for all.
    size_t without_copies(std::span<Part> parts) {
        std::vector<std::pair<CornerBits, Part>> keyed;
        for (const Part& part : parts) keyed.push_back({sorted_bits(corners(part.name)), part});
        std::sort(keyed.begin(), keyed.end(), [](const auto& a, const auto& b) {
            return a.first != b.first ? a.first < b.first : a.second.name < b.second.name;
        });
        size_t left = 0;
        const std::pair<CornerBits, Part>* lowest = nullptr;
        for (const auto& next : keyed) {
            const bool is_copy = lowest && lowest->first == next.first;
            if (is_copy && lowest->second.name.instance != next.second.name.instance) {
                compare(lowest->second, next.second);
            } else {
                lowest = &next;
                parts[left++] = next.second;
            }
        }
        return left;
    }

    bool is_wanted(const Part& part) const { return wanted_.empty() || wanted_[part.name.instance]; }

    void compare(const Part& a, const Part& b) {
        if (!is_wanted(a) && !is_wanted(b)) return;
        const Corners corners_a = corners(a.name), corners_b = corners(b.name);
        if (!shares_surface(corners_a, corners_b)) return;
        pairs_.push_back(
            {std::max(a.name, b.name), std::min(a.name, b.name), sorted_bits(corners_a) == sorted_bits(corners_b)});
    }

    std::span<const PlacedMesh> scene_;
    const std::vector<WorldBox>& boxes_;
    const std::vector<bool>& wanted_;
    std::vector<CoincidentPair>& pairs_;
};

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

constexpr double kBinsPerTriangle = 16.0;
constexpr double kMostBins = 1u << 18;  // of all entries, but for two a triangle
constexpr double kBinRoom = 0.02;       // of a bin: for the rounding of u and v

// Bins along a side, for an entry of `count` triangles among so many entries.
double bins_for(size_t count, size_t entries) {
    const auto n = static_cast<double>(count);
    const double allowed = std::max(kMostBins / static_cast<double>(entries), 2.0 * n);
    return std::max(1.0, std::floor(std::sqrt(std::min(kBinsPerTriangle * n, allowed))));
}

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

// FNV-1a of the words.
uint64_t key_of(const CornerBits& bits) {
    uint64_t key = 0xCBF29CE484222325u;
    for (const std::array<uint32_t, 3>& corner : bits) {
        for (const uint32_t word : corner) key = (key ^ word) * 0x100000001B3u;
    }
    return key ^ (key >> 32);
}

// The triangles of a mesh that have the corners of a lower one.
void find_copies_within(const PlacedMesh& mesh, uint32_t instance, std::vector<CoincidentPair>& pairs) {
    const auto bits_of = [&](uint32_t i) { return sorted_bits(corners_of(mesh, i)); };
    std::vector<uint64_t> keys(mesh.triangle_count);
    for (uint32_t i = 0; i < mesh.triangle_count; ++i) keys[i] = key_of(bits_of(i));
    std::vector<uint64_t> sorted = keys;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) return;
    std::vector<std::pair<uint64_t, uint32_t>> several;
    for (uint32_t i = 0; i < mesh.triangle_count; ++i) {
        const auto [first, end] = std::equal_range(sorted.begin(), sorted.end(), keys[i]);
        if (end - first > 1) several.push_back({keys[i], i});
    }
    std::sort(several.begin(), several.end());
    size_t lowest = 0;
    for (size_t i = 1; i < several.size(); ++i) {
        if (several[i].first != several[lowest].first) {
            lowest = i;
        } else if (bits_of(several[i].second) == bits_of(several[lowest].second)) {
            pairs.push_back({{instance, several[i].second}, {instance, several[lowest].second}, true});
        }
    }
}

}  // namespace

void CoincidentSurfaces::find(std::span<const PlacedMesh> scene) {
    pairs_.clear();
    boxes_.clear();
    for (uint32_t i = 0; i < scene.size(); ++i) {
        boxes_.push_back(box_of(scene[i]));
        find_copies_within(scene[i], i, pairs_);
    }
    const std::vector<bool> all;
    PairSearch(scene, boxes_, all, pairs_).run();
    std::sort(pairs_.begin(), pairs_.end());
    make_entries(scene, all);
}

void CoincidentSurfaces::follow(std::span<const PlacedMesh> scene, std::span<const uint32_t> changed) {
    std::vector<bool> moved(scene.size(), false);
    for (const uint32_t i : changed) moved[i] = true;
    // Of copies one has stood for all: where one goes the others are to be compared themselves.
    std::vector<bool> wanted = moved;
    for (const CoincidentPair& pair : pairs_) {
        if (!pair.same_corners || !(moved[pair.upper.instance] || moved[pair.lower.instance])) continue;
        wanted[pair.upper.instance] = wanted[pair.lower.instance] = true;
    }
    std::erase_if(pairs_, [&](const CoincidentPair& pair) {
        const bool is_old = wanted[pair.upper.instance] || wanted[pair.lower.instance];
        return is_old && pair.upper.instance != pair.lower.instance;
    });
    for (const uint32_t i : changed) boxes_[i] = box_of(scene[i]);
    PairSearch(scene, boxes_, wanted, pairs_).run();
    std::sort(pairs_.begin(), pairs_.end());
    make_entries(scene, wanted);
}

// Of instances that have not changed the bins are still right; without any flag all are new.
void CoincidentSurfaces::make_entries(std::span<const PlacedMesh> scene, const std::vector<bool>& changed) {
    struct Lower {
        TriangleName triangle;
        std::vector<TriangleName> lower;
    };
    std::vector<Lower> all;
    for (const CoincidentPair& pair : pairs_) {
        if (all.empty() || all.back().triangle != pair.upper) all.push_back({pair.upper, {}});
        all.back().lower.push_back(pair.lower);
    }
    // What lies in the place of a copy's lowest lies in the copy's as well.
    const auto lower_of = [&](const TriangleName& triangle) -> std::vector<TriangleName>* {
        const auto at = std::lower_bound(all.begin(), all.end(), triangle,
                                         [](const Lower& entry, const TriangleName& t) { return entry.triangle < t; });
        return at != all.end() && at->triangle == triangle ? &at->lower : nullptr;
    };
    for (const CoincidentPair& pair : pairs_) {
        const std::vector<TriangleName>* of_lowest = pair.same_corners ? lower_of(pair.lower) : nullptr;
        if (!of_lowest) continue;
        std::vector<TriangleName>& lower = *lower_of(pair.upper);
        lower.insert(lower.end(), of_lowest->begin(), of_lowest->end());
        std::sort(lower.begin(), lower.end());
        lower.erase(std::unique(lower.begin(), lower.end()), lower.end());
    }
    const auto is_changed = [&](const TriangleName& name) { return changed.empty() || changed[name.instance]; };
    std::vector<Entry> before = std::move(entries_);
    entries_.clear();
    auto old = before.begin();
    for (const Lower& entry : all) {
        old = std::find_if(old, before.end(), [&](const Entry& e) { return !(e.triangle < entry.triangle); });
        const bool is_there = old != before.end() && old->triangle == entry.triangle && old->lower == entry.lower;
        if (is_there && !is_changed(entry.triangle) &&
            std::none_of(entry.lower.begin(), entry.lower.end(), is_changed)) {
            entries_.push_back(std::move(*old));
        } else {
            const double side = bins_for(entry.lower.size(), all.size());
            entries_.push_back(entry_of(scene, entry.triangle, entry.lower, side));
        }
    }
}

namespace {

constexpr uint32_t kNothing = ~0u;

// hash_bits and hash_pair of the kernels.
uint32_t hash_bits(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
uint32_t hash_pair(uint32_t a, uint32_t b) { return hash_bits(a ^ (hash_bits(b) + 0x9e3779b9u)); }

}  // namespace

std::vector<glm::uvec4> pack_coincident(std::span<const CoincidentSurfaces::Entry> entries,
                                        const std::function<CoincidentTriangle(const TriangleName&)>& triangle_of) {
    if (entries.empty()) return {};
    const uint32_t mask = std::bit_ceil(static_cast<uint32_t>(entries.size()) * 2) - 1;
    std::vector<glm::uvec4> rows(size_t{mask} + 2, glm::uvec4(kNothing, 0, 0, 0));
    std::vector<glm::uvec4> partners;
    for (const CoincidentSurfaces::Entry& entry : entries) {
        const uint32_t handle = triangle_of(entry.triangle).handle;
        uint32_t place = hash_pair(entry.triangle.instance, handle) & mask;
        while (rows[place + 1].x != kNothing) place = (place + 1) & mask;
        rows[place + 1] = glm::uvec4(entry.triangle.instance, handle, rows.size(), entry.side);
        for (const std::vector<TriangleName>& bin : entry.bins) {
            rows.push_back(glm::uvec4(partners.size(), bin.size(), 0, 0));
            for (const TriangleName& name : bin) {
                const CoincidentTriangle lower = triangle_of(name);
                const auto opacity = std::bit_cast<uint32_t>(lower.opacity);
                partners.push_back(glm::uvec4(name.instance, lower.handle, name.primitive, opacity));
            }
        }
    }
    rows[0] = glm::uvec4(mask, rows.size(), 0, 0);
    rows.insert(rows.end(), partners.begin(), partners.end());
    return rows;
}

}  // namespace render_system
