// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "render_system/coincident_geometry.h"

namespace render_system::coincident {

/// A triangle or an instance, and where it is.
struct Part {
    WorldBox box;
    TriangleName name;
};

/// A tree over parts of space, made as far as a join asks for it: where one instance is alone nothing is sorted.
class PartTree {
public:
    /// Pairs with a `wanted` instance are looked for; empty: all.
    PartTree(std::vector<Part> parts, const std::vector<bool>& wanted) : parts_(std::move(parts)), wanted_(wanted) {
        if (!parts_.empty()) nodes_.push_back(node_of(0, static_cast<uint32_t>(parts_.size())));
    }

    /// Calls visit(a, b) once for any two parts of different instances, one of them wanted, whose boxes overlap; visits
    /// no more when `work`, in comparisons, is used up. Where many parts have the same middle, thin(parts) puts those
    /// first that have to stay, and says how many these are.
    template <class Visit, class Thin>
    void join(uint64_t& work, const Visit& visit, const Thin& thin) {
        if (!nodes_.empty()) join_within(0, work, visit, thin);
    }

private:
    static constexpr uint32_t kSeveral = ~0u;
    static constexpr size_t kLeafParts = 8;
    static constexpr int kDeepest = 48;  // halvings by the mean

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
        node.is_leaf = count <= kLeafParts;
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

}  // namespace render_system::coincident
