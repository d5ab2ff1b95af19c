// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/device/surface_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "target_core/core_mesh.h"
#include "target_core/device/bindings.h"
#include "target_core/device/instance_geometry.h"

namespace target_core {
namespace {

using Surface = std::array<uint, 4>;

constexpr uint TRIANGLES = 7;
constexpr uint MATERIALS = 5;

class SurfaceOrder : public testing::TestWithParam<uint> {
protected:
    void SetUp() override {
        InstanceGeometry instance;
        instance.positions = positions_.data();
        instance.triangle_count = TRIANGLES;
        geometry_.assign(1000, instance);
        for (uint i = 0; i < geometry_.size(); ++i) {
            geometry_[i].triangles = &triangles_[material_of(i) * TRIANGLES];
        }
        for (uint i = 0; i < triangles_.size(); ++i) {
            triangles_[i] = uvec4(0u, 1u, 2u, i / TRIANGLES);
        }
        bound = {};
        bound.geometry = geometry_.data();
    }
    void TearDown() override { bound = {}; }

    static uint material_of(uint instance) { return instance * 3 % MATERIALS; }

    static std::vector<Surface> surfaces_of(const Tile& tile) {
        std::vector<Surface> result;
        for (uint i = 0; i < tile.surface_count; ++i) {
            const uvec4& row = tile.surfaces[i];
            result.push_back({row.x, row.y, row.z, row.w});
        }
        return result;
    }

    std::vector<PackedVertex> positions_ = std::vector<PackedVertex>(3);
    std::vector<uvec4> triangles_ = std::vector<uvec4>(TRIANGLES * MATERIALS);
    std::vector<InstanceGeometry> geometry_;
};

TEST_P(SurfaceOrder, IsAPermutationThatBringsInstancesAndMaterialsTogether) {
    assign_bins(std::span(geometry_).first(200));
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
    uint material_changes = 0;
    for (size_t i = 1; i < after.size(); ++i) {
        changes += after[i][1] != after[i - 1][1] ? 1 : 0;
        material_changes += material_of(after[i][1]) != material_of(after[i - 1][1]) ? 1 : 0;
    }
    EXPECT_LT(changes, 200u) << "each instance in one piece";
    EXPECT_LT(material_changes, MATERIALS) << "each material in one piece";
}

TEST_F(SurfaceOrder, LosesNothingWhereInstancesShareABin) {
    assign_bins(geometry_);
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

TEST_F(SurfaceOrder, InstancesThatShareABinShareAMaterialMostly) {
    assign_bins(geometry_);
    // 1000 instances in 256 bins: a bin holds at most four, and two materials meet in four bins only.
    std::vector<std::vector<uint>> bins(256);
    for (uint i = 0; i < geometry_.size(); ++i) {
        ASSERT_LT(geometry_[i].bin, bins.size());
        bins[geometry_[i].bin].push_back(material_of(i));
    }
    uint mixed = 0;
    for (const std::vector<uint>& materials : bins) {
        EXPECT_LE(materials.size(), 4u);
        mixed += materials.empty() || std::count(materials.begin(), materials.end(), materials[0]) ==
                                          static_cast<ptrdiff_t>(materials.size())
                     ? 0
                     : 1;
    }
    EXPECT_LT(mixed, MATERIALS);
}

TEST_F(SurfaceOrder, AScenesInstancesAreGivenBins) {
    std::vector<render_system::CoreMaterial> materials(2);
    std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    std::vector<glm::vec3> normals(3, glm::vec3(0, 0, 1));
    CoreMeshes meshes;
    for (uint mesh : {0u, 1u}) {
        std::vector<glm::uvec4> triangle = {{0, 1, 2, 1 - mesh}};
        meshes.set_mesh(mesh, {positions, normals, {}, {}, {}, {}, {}, {}, triangle});
        meshes.set_instance(mesh, mesh, {});
    }
    meshes.place(materials);
    EXPECT_GT(meshes.geometry()[0].bin, meshes.geometry()[1].bin) << "materials 1 and 0";
}

TEST_F(SurfaceOrder, NoInstancesNeedNoBins) { assign_bins({}); }

INSTANTIATE_TEST_SUITE_P(Counts, SurfaceOrder, testing::Values(0u, 1u, 15u, 16u, 17u, 2047u, TILE_PATHS));

}  // namespace
}  // namespace target_core
