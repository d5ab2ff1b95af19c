// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/device/surface_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "target_core/device/bindings.h"
#include "target_core/device/instance_geometry.h"

namespace target_core {
namespace {

using Surface = std::array<uint, 4>;

class SurfaceOrder : public testing::TestWithParam<uint> {
protected:
    void SetUp() override {
        InstanceGeometry instance;
        instance.positions = positions_.data();
        instance.triangles = triangles_.data();
        instance.triangle_count = static_cast<uint>(triangles_.size());
        geometry_.assign(1000, instance);
        bound = {};
        bound.geometry = geometry_.data();
    }
    void TearDown() override { bound = {}; }

    static std::vector<Surface> surfaces_of(const Tile& tile) {
        std::vector<Surface> result;
        for (uint i = 0; i < tile.surface_count; ++i) {
            const uvec4& row = tile.surfaces[i];
            result.push_back({row.x, row.y, row.z, row.w});
        }
        return result;
    }

    std::vector<PackedVertex> positions_ = std::vector<PackedVertex>(3);
    std::vector<uvec4> triangles_ = std::vector<uvec4>(7, uvec4(0u, 1u, 2u, 0u));
    std::vector<InstanceGeometry> geometry_;
};

TEST_P(SurfaceOrder, IsAPermutationThatBringsInstancesTogether) {
    Tile tile;
    std::mt19937 dice(GetParam());
    tile.surface_count = GetParam();
    for (uint i = 0; i < tile.surface_count; ++i) {
        tile.surfaces[i] = uvec4(i, static_cast<uint>(dice() % 200), static_cast<uint>(dice() % 7), 0u);
    }
    std::vector<Surface> before = surfaces_of(tile);
    order_surfaces(tile);
    std::vector<Surface> after = surfaces_of(tile);
    EXPECT_TRUE(std::is_permutation(before.begin(), before.end(), after.begin(), after.end()));
    uint changes = 0;
    for (size_t i = 1; i < after.size(); ++i) {
        changes += after[i][1] != after[i - 1][1] ? 1 : 0;
    }
    EXPECT_LT(changes, 200u) << "each instance in one piece";
}

TEST_F(SurfaceOrder, LosesNothingWhereInstancesShareABin) {
    Tile tile;
    tile.surface_count = TILE_PATHS;
    for (uint i = 0; i < tile.surface_count; ++i) {
        tile.surfaces[i] = uvec4(i, i % 1000, 0u, 0u);
    }
    std::vector<Surface> before = surfaces_of(tile);
    order_surfaces(tile);
    std::vector<Surface> after = surfaces_of(tile);
    EXPECT_TRUE(std::is_permutation(before.begin(), before.end(), after.begin(), after.end()));
}

INSTANTIATE_TEST_SUITE_P(Counts, SurfaceOrder, testing::Values(0u, 1u, 15u, 16u, 17u, 2047u, TILE_PATHS));

}  // namespace
}  // namespace target_core
