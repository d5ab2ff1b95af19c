// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/core_mesh.h"

#include <gtest/gtest.h>

#include <vector>

namespace target_core::core_mesh_test {
namespace {

using render_system::CoreMaterial;
using render_system::CoreMesh;
using render_system::CoreTransform;

CoreMesh triangle() {
    static const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, normals(3, glm::vec3(0, 0, 1));
    static const std::vector<glm::uvec4> triangles = {{0, 1, 2, 0}};
    CoreMesh mesh;
    mesh.positions = positions;
    mesh.normals = normals;
    mesh.triangles = triangles;
    return mesh;
}

// What is to move is met through its instance's transform from the first tree on, as it will be in all later ones.
TEST(CoreMeshes, WhatIsSaidToMoveIsNeverBaked) {
    const std::vector<CoreMaterial> materials(1);
    for (const bool deforms : {false, true}) {
        CoreMesh told = triangle();
        (deforms ? told.deforms : told.moves) = true;
        CoreMeshes meshes;
        meshes.set_mesh(0, triangle());
        meshes.set_mesh(1, told);
        meshes.set_instance(0, 0, CoreTransform());
        meshes.set_instance(1, 1, CoreTransform());
        EXPECT_TRUE(meshes.is_alive());
        meshes.place(materials);
        meshes.settle();
        EXPECT_TRUE(meshes.geometry()[0].baked);
        EXPECT_FALSE(meshes.geometry()[1].baked);
        EXPECT_EQ(meshes.geometry()[1].deforms, deforms);
        CoreTransform aside;
        aside.rows[0].w = 2.0f;
        if (deforms)
            meshes.set_mesh(1, told);
        else
            meshes.set_instance(1, 1, aside);
        EXPECT_FALSE(meshes.edits().shape) << "the trees that there are can follow";
        meshes.set_instance(0, 0, aside);
        EXPECT_TRUE(meshes.edits().shape) << "of that one nobody was told";
    }
}

}  // namespace
}  // namespace target_core::core_mesh_test
