// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/acceleration/bvh.h"

#include <algorithm>

#include "source_core/acceleration/binary_tree.h"

namespace source_core {

namespace {

constexpr uint32_t WIDTH = 4;
constexpr float NOWHERE = 1.0e30f;

// Ways to build, from the fastest tree to that of the least depth.
struct Attempt {
    uint32_t median_depth;  // splits are medians from this depth on
    bool fold_by_area;      // else by level: then a tree of medians needs 3 entries for every factor of 4
};
constexpr Attempt ATTEMPTS[] = {{48, true}, {24, true}, {12, true}, {0, false}};

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
    Folder(const std::vector<BinaryNode>& binary, const std::vector<BuildPrimitive>& primitives, bool by_area)
        : binary_(binary), primitives_(primitives), by_area_(by_area) {}

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
        uint32_t levels[WIDTH] = {1, 1};
        uint32_t count = 2;
        while (count < WIDTH) {
            const int chosen = choose_inner(children, levels, count);
            if (chosen < 0) {
                break;
            }
            const uint32_t pair = binary_[children[chosen]].first;
            children[chosen] = pair;
            children[count] = pair + 1;
            levels[count] = ++levels[chosen];
            ++count;
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

    // The inner child to take in next; -1: there is none.
    int choose_inner(const uint32_t* children, const uint32_t* levels, uint32_t count) const {
        int chosen = -1;
        for (uint32_t i = 0; i < count; ++i) {
            const BinaryNode& child = binary_[children[i]];
            if (child.count != 0) {
                continue;
            }
            const bool larger = chosen < 0 || half_area(child) > half_area(binary_[children[chosen]]);
            const bool higher = chosen < 0 || levels[i] < levels[chosen];
            if (by_area_ ? larger : higher) {
                chosen = static_cast<int>(i);
            }
        }
        return chosen;
    }

    const std::vector<BinaryNode>& binary_;
    const std::vector<BuildPrimitive>& primitives_;
    bool by_area_;
    WideTree tree_;
};

bool is_empty_child(const WideNode& node, uint32_t child) { return node.bounds[0][child] == NOWHERE; }

BinaryNode child_box(const WideNode& node, uint32_t child) {
    BinaryNode box{};
    for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = node.bounds[2 * axis][child];
        box.upper[axis] = node.bounds[2 * axis + 1][child];
    }
    return box;
}

void include(BinaryNode& box, const glm::vec3& lower, const glm::vec3& upper) {
    box.lower = glm::min(box.lower, lower);
    box.upper = glm::max(box.upper, upper);
}

// Around all children of a node.
BinaryNode node_box(const WideNode& node) {
    BinaryNode box{glm::vec3(NOWHERE), 0, glm::vec3(-NOWHERE), 0};
    for (uint32_t child = 0; child < WIDTH; ++child) {
        if (is_empty_child(node, child)) {
            continue;
        }
        const BinaryNode own = child_box(node, child);
        include(box, own.lower, own.upper);
    }
    return box;
}

BinaryNode leaf_box(uint32_t word, std::span<const glm::vec4> rows) {
    const size_t first = word & LEAF_FIRST_MASK;
    const size_t count = (word >> LEAF_COUNT_SHIFT) & LEAF_COUNT_MASK;
    glm::vec4 lower(NOWHERE), upper(-NOWHERE);
    for (const glm::vec4& vertex : rows.subspan(first * TRIANGLE_ROWS, count * TRIANGLE_ROWS)) {
        lower = glm::min(lower, vertex);
        upper = glm::max(upper, vertex);
    }
    return {glm::vec3(lower), 0, glm::vec3(upper), 0};
}

}  // namespace

// Nodes come before those below them, so that from the back each node's children are done.
void refit_wide_tree(WideTree& tree, std::span<const glm::vec4> rows) {
    for (size_t i = tree.nodes.size(); i-- > 0;) {
        WideNode& node = tree.nodes[i];
        for (uint32_t child = 0; child < WIDTH; ++child) {
            const uint32_t word = node.children[child];
            if (!is_empty_child(node, child)) {
                set_child_box(node, child, (word & LEAF) != 0 ? leaf_box(word, rows) : node_box(tree.nodes[word]));
            }
        }
    }
}

double walk_cost(const WideTree& tree) {
    const double root = static_cast<double>(half_area(node_box(tree.nodes[0])));
    double sum = 0.0;
    for (const WideNode& node : tree.nodes) {
        for (uint32_t child = 0; child < WIDTH; ++child) {
            sum += is_empty_child(node, child) ? 0.0 : static_cast<double>(half_area(child_box(node, child)));
        }
    }
    return root > 0.0 ? sum / root : 0.0;
}

WideTree build_wide_tree(std::vector<BuildPrimitive> primitives, uint32_t threads, uint32_t stack_limit) {
    WideTree tree;
    if (primitives.empty()) {
        tree.nodes.push_back(empty_node());
        return tree;
    }
    for (const Attempt& attempt : ATTEMPTS) {
        const std::vector<BinaryNode> binary = build_binary_tree(primitives, threads, attempt.median_depth);
        tree = Folder(binary, primitives, attempt.fold_by_area).fold();
        if (tree.stack_need <= stack_limit) {
            break;
        }
    }
    return tree;
}

}  // namespace source_core
