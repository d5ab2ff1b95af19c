// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/acceleration/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <random>

using source_core::BuildPrimitive;
using source_core::WideNode;
using source_core::WideTree;

namespace {

constexpr uint32_t NO_LIMIT = 1000;

struct Box {
    glm::vec3 lower;
    glm::vec3 upper;
};

std::vector<BuildPrimitive> random_boxes(uint32_t count, float scale, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-scale, scale);
    std::uniform_real_distribution<float> size(0.0f, scale * 0.05f);
    std::vector<BuildPrimitive> primitives;
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec3 lower(place(random), place(random), place(random));
        primitives.push_back({lower, i, lower + glm::vec3(size(random), size(random), size(random)), 0});
    }
    return primitives;
}

Box child_box(const WideNode& node, int child) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = node.bounds[2 * axis][child];
        box.upper[axis] = node.bounds[2 * axis + 1][child];
    }
    return box;
}

bool contains(const Box& box, const BuildPrimitive& primitive) {
    return glm::all(glm::lessThanEqual(box.lower, primitive.lower)) &&
           glm::all(glm::greaterThanEqual(box.upper, primitive.upper));
}

// Walks the whole tree; every primitive must be met once, inside all boxes above it. Returns the stack that a walk
// which meets every box needs.
uint32_t expect_sound(const WideTree& tree, const std::vector<BuildPrimitive>& primitives) {
    std::vector<int> met(primitives.size(), 0);
    std::vector<int> slots(tree.order.size(), 0);
    const std::function<uint32_t(uint32_t, const std::vector<Box>&)> visit = [&](uint32_t index,
                                                                                 const std::vector<Box>& above) {
        uint32_t children = 0;
        uint32_t below = 0;
        for (int child = 0; child < 4; ++child) {
            const uint32_t word = tree.nodes.at(index).children[child];
            std::vector<Box> boxes = above;
            boxes.push_back(child_box(tree.nodes[index], child));
            if ((word & source_core::LEAF) == 0) {
                ++children;
                below = std::max(below, visit(word, boxes));
                continue;
            }
            const uint32_t count = (word >> source_core::LEAF_COUNT_SHIFT) & source_core::LEAF_COUNT_MASK;
            const uint32_t first = word & source_core::LEAF_FIRST_MASK;
            children += count > 0 ? 1 : 0;
            std::vector<uint32_t> ids;
            if (count == source_core::LEAF_INSTANCE) {
                ids.push_back(first);
                EXPECT_EQ(primitives.at(first).alone, 1u);
            }
            for (uint32_t i = 0; count != source_core::LEAF_INSTANCE && i < count; ++i) {
                ids.push_back(tree.order.at(first + i));
                ++slots.at(first + i);
                EXPECT_EQ(primitives.at(ids.back()).alone, 0u);
            }
            for (const uint32_t id : ids) {
                ++met.at(id);
                for (const Box& box : boxes) {
                    EXPECT_TRUE(contains(box, primitives[id])) << "primitive " << id;
                }
            }
        }
        return below + (children > 0 ? children - 1 : 0);
    };
    const uint32_t need = visit(0, {});
    EXPECT_TRUE(std::all_of(met.begin(), met.end(), [](int times) { return times == 1; }));
    EXPECT_TRUE(std::all_of(slots.begin(), slots.end(), [](int times) { return times == 1; }));
    EXPECT_LE(need, tree.stack_need);
    return need;
}

}  // namespace

TEST(WideTree, NothingIsARootOfEmptyChildren) {
    const WideTree tree = source_core::build_wide_tree({}, 1, NO_LIMIT);
    ASSERT_EQ(tree.nodes.size(), 1u);
    for (const uint32_t word : tree.nodes[0].children) {
        EXPECT_EQ(word, source_core::LEAF);
    }
    EXPECT_EQ(tree.nodes[0].bounds[0][0], 1.0e30f);
    EXPECT_EQ(tree.nodes[0].bounds[1][3], 1.0e30f);
}

TEST(WideTree, HoldsEveryPrimitiveOnceInsideItsBoxes) {
    for (const uint32_t count : {1u, 2u, 3u, 4u, 5u, 17u, 100u, 5000u}) {
        SCOPED_TRACE(count);
        const auto primitives = random_boxes(count, 10.0f, count);
        expect_sound(source_core::build_wide_tree(primitives, 1, NO_LIMIT), primitives);
    }
}

TEST(WideTree, HugeAndTinyCoordinatesAreSound) {
    for (const float scale : {1e-30f, 1e-10f, 1e10f, 1e17f}) {
        SCOPED_TRACE(scale);
        const auto primitives = random_boxes(500, scale, 3);
        expect_sound(source_core::build_wide_tree(primitives, 1, NO_LIMIT), primitives);
    }
}

TEST(WideTree, EqualBoxesAreSplitAllTheSame) {
    std::vector<BuildPrimitive> primitives(1000, BuildPrimitive{glm::vec3(1.0f), 0, glm::vec3(2.0f), 0});
    for (uint32_t i = 0; i < primitives.size(); ++i) {
        primitives[i].id = i;
    }
    const WideTree tree = source_core::build_wide_tree(primitives, 1, NO_LIMIT);
    expect_sound(tree, primitives);
    EXPECT_LT(tree.stack_need, 40u);
}

TEST(WideTree, InstancesStandAlone) {
    auto primitives = random_boxes(200, 1.0f, 5);
    for (uint32_t i = 0; i < primitives.size(); i += 3) {
        primitives[i].alone = 1;
    }
    expect_sound(source_core::build_wide_tree(primitives, 1, NO_LIMIT), primitives);
    std::vector<BuildPrimitive> same(9, BuildPrimitive{glm::vec3(0.0f), 0, glm::vec3(1.0f), 1});
    for (uint32_t i = 0; i < same.size(); ++i) {
        same[i].id = i;
    }
    expect_sound(source_core::build_wide_tree(same, 1, NO_LIMIT), same);
}

TEST(WideTree, DoesNotDependOnThreads) {
    const auto primitives = random_boxes(60000, 10.0f, 9);
    const WideTree one = source_core::build_wide_tree(primitives, 1, NO_LIMIT);
    for (const uint32_t threads : {2u, 5u}) {
        const WideTree several = source_core::build_wide_tree(primitives, threads, NO_LIMIT);
        ASSERT_EQ(several.nodes.size(), one.nodes.size());
        EXPECT_EQ(several.order, one.order);
        EXPECT_EQ(std::memcmp(several.nodes.data(), one.nodes.data(), one.nodes.size() * sizeof(WideNode)), 0);
    }
}

TEST(WideTree, KeepsToTheStackItIsGiven) {
    // Sizes that grow by a factor from one to the next make the heuristic peel them off one by one.
    std::vector<BuildPrimitive> primitives;
    float place = 1.0f;
    for (uint32_t i = 0; i < 400; ++i) {
        place *= 1.2f;
        primitives.push_back({glm::vec3(place), i, glm::vec3(place * 1.1f), 0});
    }
    const WideTree deep = source_core::build_wide_tree(primitives, 1, NO_LIMIT);
    const WideTree shallow = source_core::build_wide_tree(primitives, 1, 15);
    EXPECT_GT(deep.stack_need, 15u) << "the case is too easy to show anything";
    EXPECT_LE(shallow.stack_need, 15u);
    EXPECT_EQ(expect_sound(shallow, primitives), shallow.stack_need);
}

TEST(WideTree, TheHeuristicBeatsMedians) {
    // Expected box tests of a ray through the root: the sum of the children's areas over the root's.
    const auto cost = [](const WideTree& tree) {
        double sum = 0.0;
        for (const WideNode& node : tree.nodes) {
            for (int child = 0; child < 4; ++child) {
                if (node.children[child] != source_core::LEAF) {
                    const Box box = child_box(node, child);
                    const glm::vec3 size = box.upper - box.lower;
                    sum += size.x * size.y + size.y * size.z + size.z * size.x;
                }
            }
        }
        return sum;
    };
    auto primitives = random_boxes(3000, 10.0f, 2);
    for (uint32_t i = 0; i < 300; ++i) {
        primitives[i].upper = primitives[i].lower + glm::vec3(8.0f, 0.0f, 0.1f);  // a few long boards
    }
    const double heuristic = cost(source_core::build_wide_tree(primitives, 1, NO_LIMIT));
    const double medians = cost(source_core::build_wide_tree(primitives, 1, 0));
    EXPECT_LT(heuristic, 0.8 * medians);
}
