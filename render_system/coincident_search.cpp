// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/coincident_search.h"

#include <algorithm>

#include "render_system/coincident_tree.h"

namespace render_system::coincident {

namespace {

constexpr size_t kMostNeighbours = 8;    // of an instance that are told apart
constexpr size_t kMostParts = 1u << 25;  // triangles near those of others, 32 bytes each
// What a search may cost in comparisons before it gives up.
constexpr uint64_t kWorkPerTriangle = 256;
constexpr uint64_t kLeastWork = 1u << 24;

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
            if (boxes.size() > kMostNeighbours) boxes = {boxes_[instance]};
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

// FNV-1a of the words.
uint64_t key_of(const CornerBits& bits) {
    uint64_t key = 0xCBF29CE484222325u;
    for (const std::array<uint32_t, 3>& corner : bits) {
        for (const uint32_t word : corner) key = (key ^ word) * 0x100000001B3u;
    }
    return key ^ (key >> 32);
}

}  // namespace

void find_between_instances(std::span<const PlacedMesh> scene, const std::vector<WorldBox>& boxes,
                            const std::vector<bool>& wanted, std::vector<CoincidentPair>& pairs) {
    PairSearch(scene, boxes, wanted, pairs).run();
}

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

}  // namespace render_system::coincident
