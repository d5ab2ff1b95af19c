// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace metrics {

/// An ordered tree in postorder: children before their parent, left before right; the root comes last.
struct Tree {
    std::vector<uint64_t> labels;
    std::vector<uint32_t> leftmost;  ///< of each node, the first leaf below it (itself for a leaf)

    size_t size() const { return labels.size(); }
    /// Adds a node above those added since `first` (the size() at the time when its first child was begun).
    void close(uint32_t first, uint64_t label) {
        labels.push_back(label);
        leftmost.push_back(first);
    }
};

/// The steps that tree_distance takes.
uint64_t tree_distance_cost(const Tree& a, const Tree& b);

/// Tree edit distance (Zhang, Shasha 1989): the fewest nodes inserted, deleted or relabelled, each at cost 1.
uint64_t tree_distance(const Tree& a, const Tree& b);

/// 2 d / (|a| + |b| + d), in [0, 1] (Li, Zhang 2011): a metric too, 0 for equal trees, 1 if one is empty. Not both may
/// be empty.
double normalized_tree_distance(const Tree& a, const Tree& b);

}  // namespace metrics
