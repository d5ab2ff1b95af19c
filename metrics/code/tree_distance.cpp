// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/code/tree_distance.h"

#include <algorithm>

namespace metrics {
namespace {

/// The nodes that have a left sibling, and the root, ascending: where a subproblem starts.
std::vector<uint32_t> key_roots(const Tree& tree) {
    std::vector<uint8_t> seen(tree.size());
    std::vector<uint32_t> out;
    for (size_t i = tree.size(); i-- > 0;) {
        if (seen[tree.leftmost[i]] == 0) out.push_back(static_cast<uint32_t>(i));
        seen[tree.leftmost[i]] = 1;
    }
    std::reverse(out.begin(), out.end());
    return out;
}

uint64_t key_root_sizes(const Tree& tree) {
    uint64_t sum = 0;
    for (const uint32_t root : key_roots(tree)) sum += root - tree.leftmost[root] + 2;
    return sum;
}

/// Fills in the distances between subtrees, one pair of key roots at a time.
class Distances {
public:
    Distances(const Tree& a, const Tree& b)
        : a_(a), b_(b), trees_(a.size() * b.size()), forests_((a.size() + 1) * (b.size() + 1)) {}

    uint64_t run() {
        const std::vector<uint32_t> roots_a = key_roots(a_), roots_b = key_roots(b_);
        for (const uint32_t i : roots_a)
            for (const uint32_t j : roots_b) compare(i, j);
        return trees_.back();
    }

private:
    uint32_t& tree(size_t i, size_t j) { return trees_[i * b_.size() + j]; }

    void compare(uint32_t root_a, uint32_t root_b) {
        const uint32_t first_a = a_.leftmost[root_a], first_b = b_.leftmost[root_b];
        const size_t width = root_b - first_b + 2;
        // forest(x, y): between the first x nodes from first_a and the first y nodes from first_b
        auto forest = [&](size_t x, size_t y) -> uint32_t& { return forests_[x * width + y]; };
        for (size_t y = 0; y < width; ++y) forest(0, y) = static_cast<uint32_t>(y);
        for (uint32_t i = first_a; i <= root_a; ++i) {
            const size_t x = i - first_a + 1;
            forest(x, 0) = static_cast<uint32_t>(x);
            for (uint32_t j = first_b; j <= root_b; ++j) {
                const size_t y = j - first_b + 1;
                const uint32_t drop_or_add = std::min(forest(x - 1, y), forest(x, y - 1)) + 1;
                if (a_.leftmost[i] == first_a && b_.leftmost[j] == first_b) {
                    const uint32_t change = a_.labels[i] == b_.labels[j] ? 0 : 1;
                    forest(x, y) = std::min(drop_or_add, forest(x - 1, y - 1) + change);
                    tree(i, j) = forest(x, y);
                } else {
                    const uint32_t before = forest(a_.leftmost[i] - first_a, b_.leftmost[j] - first_b);
                    forest(x, y) = std::min(drop_or_add, before + tree(i, j));
                }
            }
        }
    }

    const Tree& a_;
    const Tree& b_;
    std::vector<uint32_t> trees_, forests_;
};

}  // namespace

uint64_t tree_distance_cost(const Tree& a, const Tree& b) { return key_root_sizes(a) * key_root_sizes(b); }

uint64_t tree_distance(const Tree& a, const Tree& b) {
    if (a.size() == 0 || b.size() == 0) return a.size() + b.size();
    return Distances(a, b).run();
}

double normalized_tree_distance(const Tree& a, const Tree& b) {
    const auto distance = static_cast<double>(tree_distance(a, b));
    return 2 * distance / (static_cast<double>(a.size() + b.size()) + distance);
}

}  // namespace metrics
