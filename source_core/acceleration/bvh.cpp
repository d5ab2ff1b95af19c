// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/acceleration/bvh.h"

#include <algorithm>

#include "source_core/acceleration/binary_tree.h"

namespace source_core {

namespace {

constexpr uint32_t WIDTH = 4;
constexpr float NOWHERE = 1.0e30f;
constexpr uint32_t DEPTHS_TO_TRY[] = {48, 24, 12, 6, 0};  // of the heuristic's splits, before medians

WideNode empty_node() {
    WideNode node;
    for (auto& row : node.bounds) {
        std::fill(row, row + WIDTH, NOWHERE);
    }
    std::fill(node.children, node.children + WIDTH, LEAF);
    return node;
}

void set_child_box(WideNode& node, uint32_t child, const BinaryNode& box) {
    for (int axis = 0; axis < 3; ++axis) {
        node.bounds[2 * axis][child] = box.lower[axis];
        node.bounds[2 * axis + 1][child] = box.upper[axis];
    }
}

// Folds the binary tree: a wide node takes in those inner children that rays meet most often.
class Folder {
public:
    Folder(const std::vector<BinaryNode>& binary, const std::vector<BuildPrimitive>& primitives)
        : binary_(binary), primitives_(primitives) {}

    WideTree fold() {
        tree_.order.reserve(primitives_.size());
        tree_.nodes.reserve(binary_.size() / 3 + 1);
        tree_.nodes.push_back(empty_node());
        tree_.stack_need = binary_[0].count != 0 ? fold_lone_leaf() : fold_node(0, 0);
        return std::move(tree_);
    }

private:
    uint32_t fold_lone_leaf() {
        set_child_box(tree_.nodes[0], 0, binary_[0]);
        tree_.nodes[0].children[0] = leaf_word(binary_[0]);
        return 0;
    }

    uint32_t leaf_word(const BinaryNode& leaf) {
        const BuildPrimitive& first = primitives_[leaf.first];
        if (first.alone != 0) {
            return LEAF | (LEAF_INSTANCE << LEAF_COUNT_SHIFT) | first.id;
        }
        const auto slot = static_cast<uint32_t>(tree_.order.size());
        for (uint32_t i = 0; i < leaf.count; ++i) {
            tree_.order.push_back(primitives_[leaf.first + i].id);
        }
        return LEAF | (leaf.count << LEAF_COUNT_SHIFT) | slot;
    }

    // Fills node `wide` from the inner node `binary`; the stack that a walk below it needs.
    uint32_t fold_node(uint32_t binary, uint32_t wide) {
        uint32_t children[WIDTH] = {binary_[binary].first, binary_[binary].first + 1};
        uint32_t count = 2;
        while (count < WIDTH) {
            const int widest = largest_inner(children, count);
            if (widest < 0) {
                break;
            }
            const uint32_t pair = binary_[children[widest]].first;
            children[widest] = pair;
            children[count++] = pair + 1;
        }
        uint32_t need_below = 0;
        for (uint32_t i = 0; i < count; ++i) {
            const BinaryNode& child = binary_[children[i]];
            set_child_box(tree_.nodes[wide], i, child);
            if (child.count != 0) {
                tree_.nodes[wide].children[i] = leaf_word(child);
                continue;
            }
            const auto next = static_cast<uint32_t>(tree_.nodes.size());
            tree_.nodes.push_back(empty_node());
            tree_.nodes[wide].children[i] = next;
            need_below = std::max(need_below, fold_node(children[i], next));
        }
        return need_below + count - 1;
    }

    int largest_inner(const uint32_t* children, uint32_t count) const {
        int largest = -1;
        for (uint32_t i = 0; i < count; ++i) {
            const BinaryNode& child = binary_[children[i]];
            if (child.count == 0 && (largest < 0 || half_area(child) > half_area(binary_[children[largest]]))) {
                largest = static_cast<int>(i);
            }
        }
        return largest;
    }

    const std::vector<BinaryNode>& binary_;
    const std::vector<BuildPrimitive>& primitives_;
    WideTree tree_;
};

}  // namespace

WideTree build_wide_tree(std::vector<BuildPrimitive> primitives, uint32_t threads, uint32_t stack_limit) {
    WideTree tree;
    if (primitives.empty()) {
        tree.nodes.push_back(empty_node());
        return tree;
    }
    for (const uint32_t median_depth : DEPTHS_TO_TRY) {
        const std::vector<BinaryNode> binary = build_binary_tree(primitives, threads, median_depth);
        tree = Folder(binary, primitives).fold();
        if (tree.stack_need <= stack_limit) {
            break;
        }
    }
    return tree;
}

}  // namespace source_core
