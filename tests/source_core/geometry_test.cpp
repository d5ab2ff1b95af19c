// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "source_core/core_geometry.h"

using namespace source_core;
using render_system::CoreTransform;

namespace {

CoreMeshCopy one_triangle() {
    CoreMeshCopy mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2, 0}};
    mesh.vertex_rows.resize(3);
    return mesh;
}

CoreTransform moved(float x) {
    CoreTransform transform;
    transform.rows[0].w = x;
    return transform;
}

GeometryTables build(
    const std::vector<CoreMeshCopy>& meshes, const std::vector<CoreInstance>& instances,
    const OpacityOf& opacity = [](uint32_t, bool) { return 1.0f; }) {
    auto built = build_geometry(meshes, instances, opacity, 1);
    EXPECT_TRUE(built.ok()) << built.status.message;
    return *built;
}

uint32_t bits(float value) { return std::bit_cast<uint32_t>(value); }

}  // namespace

TEST(Geometry, AMeshOfOneInstanceIsBaked) {
    const GeometryTables tables = build({one_triangle()}, {{0, moved(5.0f)}});
    ASSERT_EQ(tables.triangles.size(), TRIANGLE_ROWS);
    EXPECT_EQ(tables.triangles[0], glm::vec4(5, 0, 0, 1));
    EXPECT_EQ(glm::vec3(tables.triangles[1]), glm::vec3(6, 0, 0));
    EXPECT_EQ(bits(tables.triangles[1].w), 0u);
    EXPECT_EQ(bits(tables.triangles[2].w), 0u) << "the instance's number";
    EXPECT_EQ(tables.features & FEATURE_INSTANCES, 0u);
    EXPECT_EQ(tables.nodes.size(), 1u);
    EXPECT_EQ(tables.extent, glm::vec3(6, 1, 0));
    EXPECT_EQ(tables.triangle_count, 1u);
}

TEST(Geometry, AMeshOfTwoInstancesIsStoredOnce) {
    const GeometryTables tables = build({one_triangle()}, {{0, moved(5.0f)}, {0, moved(-3.0f)}});
    ASSERT_EQ(tables.triangles.size(), TRIANGLE_ROWS);
    EXPECT_EQ(tables.triangles[0], glm::vec4(0, 0, 0, 1)) << "mesh space";
    EXPECT_EQ(bits(tables.triangles[2].w), render_system::NONE);
    EXPECT_NE(tables.features & FEATURE_INSTANCES, 0u);
    EXPECT_EQ(tables.nodes.size(), 4u) << "scene, mesh, two records";
    EXPECT_EQ(tables.triangle_count, 2u);
    EXPECT_NEAR(tables.extent.x, 6.0f, 1e-4f);
}

TEST(Geometry, ARecordLeadsBackToMeshSpace) {
    CoreTransform transform;
    transform.rows[0] = {0.0f, -2.0f, 0.0f, 1.0f};
    transform.rows[1] = {3.0f, 0.0f, 0.5f, 2.0f};
    transform.rows[2] = {0.0f, 0.25f, -4.0f, -7.0f};
    const GeometryTables tables = build({one_triangle()}, {{0, moved(50.0f)}, {0, transform}});
    const auto record = std::bit_cast<std::array<glm::vec4, NODE_ROWS>>(tables.nodes[3]);
    EXPECT_EQ(bits(record[RECORD_PAD].w), 1u) << "the mesh's root follows the scene's only node";
    EXPECT_EQ(bits(record[RECORD_INSTANCE].w), 1u);
    const glm::vec3 p(0.3f, -0.8f, 1.7f);
    glm::vec3 world;
    for (int r = 0; r < 3; ++r) {
        world[r] = glm::dot(glm::vec3(transform.rows[r]), p) + transform.rows[r].w;
    }
    for (int r = 0; r < 3; ++r) {
        EXPECT_NEAR(glm::dot(glm::vec3(record[r]), world) + record[r].w, p[r], 1e-5f);
        EXPECT_GT(record[RECORD_PAD][r], 0.0f);
        EXPECT_GT(record[RECORD_INSTANCE][r], 0.0f);
    }
}

TEST(Geometry, InstancesOfASingularMatrixAreBaked) {
    CoreTransform flat;
    flat.rows[2] = {0, 0, 0, 3};  // everything onto the plane z = 3
    const GeometryTables tables = build({one_triangle()}, {{0, flat}, {0, {}}, {0, moved(9)}});
    EXPECT_EQ(tables.triangles.size(), 2 * TRIANGLE_ROWS) << "one in mesh space, one baked";
    EXPECT_EQ(bits(tables.triangles[5].w), 0u);
    EXPECT_EQ(tables.triangles[3].z, 3.0f);
}

TEST(Geometry, HiddenInstancesLeaveNothing) {
    const GeometryTables tables = build({one_triangle()}, {{render_system::NONE, {}}, {0, {}}});
    EXPECT_EQ(tables.triangles.size(), TRIANGLE_ROWS);
    EXPECT_EQ(bits(tables.triangles[2].w), 1u);
    EXPECT_EQ(tables.instances.size(), 2 * INSTANCE_ROWS);
    EXPECT_EQ(tables.triangle_count, 1u);
}

TEST(Geometry, TrianglesThatNoRayCanHitAreLeftOut) {
    CoreMeshCopy mesh = one_triangle();
    mesh.positions.push_back(glm::vec3(std::numeric_limits<float>::infinity()));
    mesh.positions.push_back(glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    mesh.positions.push_back(glm::vec3(1e20f));
    mesh.triangles.push_back({0, 1, 3, 0});
    mesh.triangles.push_back({0, 1, 4, 0});
    mesh.triangles.push_back({0, 1, 5, 0});
    const GeometryTables tables = build({mesh}, {{0, {}}});
    EXPECT_EQ(tables.triangles.size(), TRIANGLE_ROWS);
    EXPECT_EQ(tables.mesh_triangles.size(), 4u);
}

TEST(Geometry, OpacityTravelsWithTheTriangle) {
    CoreMeshCopy mesh = one_triangle();
    mesh.triangles.push_back({0, 1, 2, 1});
    mesh.triangles.push_back({0, 1, 2, 2});
    const float codes[] = {1.0f, 0.25f, -1.0f};
    const GeometryTables tables =
        build({mesh}, {{0, {}}}, [&codes](uint32_t material, bool) { return codes[material]; });
    for (size_t slot = 0; slot < 3; ++slot) {
        const uint32_t primitive = bits(tables.triangles[slot * TRIANGLE_ROWS + 1].w);
        EXPECT_EQ(tables.triangles[slot * TRIANGLE_ROWS].w, codes[primitive]);
    }
    EXPECT_EQ(tables.features, FEATURE_ALPHA | FEATURE_ALPHA_TEXTURES);
}

namespace {

const OpacityOf kOpaque = [](uint32_t, bool) { return 1.0f; };

uint64_t patched_bytes(const GeometryUpdate& update, const std::vector<CoreMeshCopy>& meshes, uint32_t table) {
    uint64_t bytes = 0;
    for (const TablePatch& patch : update.patches) {
        bytes += patch.table == table ? bytes_of(patch, meshes).size() : 0;
    }
    return bytes;
}

// `side` x `side` squares at z = 0.
CoreMeshCopy flat_sheet(uint32_t side) {
    CoreMeshCopy mesh;
    for (uint32_t i = 0; i < (side + 1) * (side + 1); ++i) {
        mesh.positions.push_back({static_cast<float>(i % (side + 1)), static_cast<float>(i / (side + 1)), 0.0f});
    }
    for (uint32_t i = 0; i < side * side; ++i) {
        const uint32_t corner = i / side * (side + 1) + i % side;
        mesh.triangles.push_back({corner, corner + 1, corner + side + 1, 0});
        mesh.triangles.push_back({corner + 1, corner + side + 2, corner + side + 1, 0});
    }
    mesh.vertex_rows.resize(mesh.positions.size());
    return mesh;
}

}  // namespace

TEST(Geometry, AMovedInstanceTouchesItsRecordAndTheTopAlone) {
    const std::vector<CoreMeshCopy> meshes = {flat_sheet(20)};
    std::vector<CoreInstance> instances;
    for (int i = 0; i < 50; ++i) {
        instances.push_back({0, moved(30.0f * static_cast<float>(i))});
    }
    GeometryTables tables = build(meshes, instances);
    instances[7].transform = moved(-90.0f);
    const auto update = update_geometry(meshes, instances, {7}, {}, kOpaque, 1, tables.plan);
    ASSERT_TRUE(update);
    EXPECT_EQ(patched_bytes(*update, meshes, BINDING_INSTANCES), INSTANCE_ROWS * sizeof(glm::vec4));
    EXPECT_EQ(patched_bytes(*update, meshes, BINDING_TRIANGLES) + patched_bytes(*update, meshes, BINDING_VERTICES), 0u);
    EXPECT_LE(patched_bytes(*update, meshes, BINDING_NODES), 51 * sizeof(WideNode));
    EXPECT_NEAR(update->extent.x, 1490.0f, 0.1f);
    for (const TablePatch& patch : update->patches) {
        const uint64_t room = (tables.nodes.size() + tables.plan.spare_count) * sizeof(WideNode);
        EXPECT_LE(patch.offset + bytes_of(patch, meshes).size(), patch.table == BINDING_NODES ? room : ~0ull);
    }
}

TEST(Geometry, WhatIsBakedIsBuiltOnceMoreWhenItFirstMovesAndThenNoMore) {
    const std::vector<CoreMeshCopy> meshes = {flat_sheet(4), one_triangle()};
    std::vector<CoreInstance> instances = {{0, moved(0.0f)}, {1, moved(1.0f)}};
    GeometryTables still = build(meshes, instances);
    EXPECT_EQ(still.features & FEATURE_INSTANCES, 0u);
    EXPECT_FALSE(update_geometry(meshes, instances, {1}, {}, kOpaque, 1, still.plan));
    MovingParts moving;
    moving.instances = {false, true};
    GeometryTables alive = *build_geometry(meshes, instances, kOpaque, 1, moving);
    EXPECT_TRUE(alive.plan.has_still);
    EXPECT_TRUE(update_geometry(meshes, instances, {1}, {}, kOpaque, 1, alive.plan));
    EXPECT_FALSE(update_geometry(meshes, instances, {0}, {}, kOpaque, 1, alive.plan)) << "that one stood still so far";
}

TEST(Geometry, WhatIsSaidToMoveNeedsNoSecondBuild) {
    const std::vector<CoreMeshCopy> meshes = {flat_sheet(4), one_triangle()};
    const std::vector<CoreInstance> instances = {{0, moved(0.0f)}, {1, moved(1.0f)}};
    MovingParts moving;
    moving.placed = {false, true};
    GeometryTables tables = *build_geometry(meshes, instances, kOpaque, 1, moving);
    EXPECT_NE(tables.features & FEATURE_INSTANCES, 0u);
    EXPECT_TRUE(update_geometry(meshes, instances, {1}, {}, kOpaque, 1, tables.plan));
    EXPECT_FALSE(update_geometry(meshes, instances, {}, {1}, kOpaque, 1, tables.plan))
        << "its vertices are another thing";
}

TEST(Geometry, ADeformedMeshIsFittedUntilItsTreeIsWorn) {
    std::vector<CoreMeshCopy> meshes = {flat_sheet(16)};
    const std::vector<CoreInstance> instances = {{0, moved(0.0f)}};
    MovingParts moving;
    moving.meshes = {true};
    GeometryTables tables = *build_geometry(meshes, instances, kOpaque, 1, moving);
    const double built = tables.plan.meshes[0].built_cost;
    EXPECT_NEAR(built, walk_cost(tables.plan.meshes[0].tree), 1e-9);
    for (glm::vec3& p : meshes[0].positions) {
        p.z = 0.01f * p.x;
    }
    ASSERT_TRUE(update_geometry(meshes, instances, {}, {0}, kOpaque, 1, tables.plan));
    EXPECT_EQ(tables.plan.meshes[0].built_cost, built) << "a little out of shape";
    EXPECT_NEAR(tables.plan.meshes[0].upper.z, 0.16f, 1e-6f);
    // Neighbours fly apart.
    std::mt19937 random(3);
    for (glm::vec3& p : meshes[0].positions) {
        p = 16.0f * glm::vec3(static_cast<float>(random() % 997), static_cast<float>(random() % 997), 0.0f) / 997.0f;
    }
    update_geometry(meshes, instances, {}, {0}, kOpaque, 1, tables.plan);
    EXPECT_NE(tables.plan.meshes[0].built_cost, built);
}
