// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "render_system/render_system.h"
#include "render_system/texture.h"
#include "tests/render_system/counting_core.h"

namespace render_system::testing::change_tracking_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

HostMesh triangle(uint32_t material) {
    HostMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, glm::vec3(0, 0, 1));
    mesh.triangles = {{0, 1, 2, material}};
    return mesh;
}

CoreTransform moved(float x) {
    CoreTransform transform;
    transform.rows[0].w = x;
    return transform;
}

// Materials 0 and 1 are dark, 2 glows; meshes and instances 0 to 2 likewise. One punctual light, one texture.
HostScene three_triangles() {
    HostScene scene;
    scene.add_texture(build_texture(placeholder_image(), TextureRole::color));
    for (uint32_t i = 0; i < 3; ++i) {
        HostMaterial material;
        if (i == 2) material.core.emission = glm::vec3(1);
        scene.add_material(material);
        scene.add_mesh(triangle(i));
        scene.add_instance(i, moved(static_cast<float>(i)));
    }
    PunctualLight light;
    light.emission = glm::vec3(1);
    scene.add_punctual_light(light);
    return scene;
}

Sky sky_map(float radiance) {
    Sky sky;
    sky.width = 2;
    sky.height = 1;
    sky.texels.assign(2, glm::vec4(radiance));
    return sky;
}

class ChangeTracking : public ::testing::Test {
protected:
    ChangeTracking() : system_(three_triangles()) {
        auto core = std::make_unique<CountingCore>(log_);
        EXPECT_TRUE(core->Init({}).ok());
        pixels_.resize(4);
        EXPECT_TRUE(core->SetTarget({2, 2, pixels_}).ok());
        system_.use_core(std::move(core));
    }

    HostScene& scene() { return system_.scene(); }

    // The calls that one synchronize makes.
    std::vector<std::string> sent() {
        log_->calls.clear();
        const Status status = system_.synchronize();
        EXPECT_TRUE(status.ok()) << status.message;
        return log_->calls;
    }

    std::shared_ptr<CountingCore::Log> log_ = std::make_shared<CountingCore::Log>();
    std::vector<glm::vec4> pixels_;
    RenderSystem system_;
};

TEST_F(ChangeTracking, EverythingGoesToANewCoreOnce) {
    EXPECT_THAT(sent(),
                ElementsAre("SetTextures 1", "SetMaterials 0+3", "SetGeometry 0", "SetGeometry 1", "SetGeometry 2",
                            "SetInstance 0", "SetInstance 1", "SetInstance 2", "SetLights 2", "SetSkyData"));
    EXPECT_THAT(sent(), IsEmpty());
    auto another = std::make_unique<CountingCore>(log_);
    EXPECT_TRUE(another->Init({}).ok());
    system_.use_core(std::move(another));
    EXPECT_EQ(sent().size(), 10u);
}

TEST_F(ChangeTracking, OneMaterial) {
    sent();
    CoreMaterial material = scene().materials()[1].core;
    material.roughness = 0.25f;
    scene().set_material(1, material);
    EXPECT_THAT(sent(), ElementsAre("SetMaterials 1+1"));
    EXPECT_THAT(sent(), IsEmpty());
}

TEST_F(ChangeTracking, NeighbouringMaterialsGoTogetherOthersApart) {
    sent();
    scene().set_material(0, CoreMaterial());
    scene().set_material(1, CoreMaterial());
    EXPECT_THAT(sent(), ElementsAre("SetMaterials 0+2"));
    CoreMaterial glowing = scene().materials()[2].core;
    scene().set_material(0, CoreMaterial());
    scene().set_material(2, glowing);
    EXPECT_THAT(sent(), ElementsAre("SetMaterials 0+1", "SetMaterials 2+1"));
}

TEST_F(ChangeTracking, TheEmissionOfAMaterialAlsoChangesTheLights) {
    sent();
    CoreMaterial material = scene().materials()[2].core;
    material.emission = glm::vec3(3);
    scene().set_material(2, material);
    EXPECT_THAT(sent(), ElementsAre("SetMaterials 2+1", "SetLights 2"));
    material.roughness = 0.5f;  // still glowing, but in the same way
    scene().set_material(2, material);
    EXPECT_THAT(sent(), ElementsAre("SetMaterials 2+1"));
    material.double_sided = true;
    scene().set_material(2, material);
    EXPECT_THAT(sent(), ElementsAre("SetMaterials 2+1", "SetLights 2"));
    material.emission = glm::vec3(0);
    scene().set_material(2, material);
    EXPECT_THAT(sent(), ElementsAre("SetMaterials 2+1", "SetLights 1"));
}

TEST_F(ChangeTracking, OneTransform) {
    sent();
    scene().set_instance_transform(1, moved(7));
    EXPECT_THAT(sent(), ElementsAre("SetInstance 1"));
    scene().set_instance_transform(2, moved(9));  // the one that glows
    EXPECT_THAT(sent(), ElementsAre("SetInstance 2", "SetLights 2"));
}

TEST_F(ChangeTracking, OneMesh) {
    sent();
    scene().set_mesh(0, triangle(0));
    EXPECT_THAT(sent(), ElementsAre("SetGeometry 0"));
    scene().set_mesh(2, triangle(2));
    EXPECT_THAT(sent(), ElementsAre("SetGeometry 2", "SetLights 2"));
    scene().set_mesh(0, triangle(2));  // begins to glow
    EXPECT_THAT(sent(), ElementsAre("SetGeometry 0", "SetLights 3"));
    scene().set_mesh(0, triangle(1));  // and stops
    EXPECT_THAT(sent(), ElementsAre("SetGeometry 0", "SetLights 2"));
}

TEST_F(ChangeTracking, WhatIsUsedIsNotRemovedAndWhatIsRemovedIsRefused) {
    sent();
    const auto refused = [](const Status& status, const std::string& message) {
        EXPECT_EQ(status.message, message);
        EXPECT_FALSE(status.ok());
    };
    refused(scene().remove_mesh(2), "mesh 2 is used by instance 2; remove that first");
    refused(scene().remove_material(2), "material 2 is used by mesh 2; remove that first");
    CoreMaterial textured;
    textured.base_color_texture.texture = 0;
    scene().set_material(0, textured);
    refused(scene().remove_texture(0), "texture 0 is used by material 0; remove that first");
    refused(scene().remove_instance(3), "instance 3 does not exist; there are 3");
    EXPECT_TRUE(scene().remove_instance(2).ok());
    refused(scene().remove_instance(2), "instance 2 has been removed already");
    EXPECT_TRUE(scene().remove_mesh(2).ok());
    EXPECT_TRUE(scene().remove_material(2).ok());
    EXPECT_TRUE(scene().remove_punctual_light(0).ok());
    EXPECT_THAT(sent(),
                ElementsAre("SetMaterials 0+1", "SetMaterials 2+1", "SetGeometry 2", "SetInstance 2", "SetLights 0"));
    EXPECT_EQ(scene().meshes()[2].positions.capacity(), 0u);
    EXPECT_EQ(scene().meshes().size(), 3u) << "ids stay";
    EXPECT_EQ(scene().add_mesh(triangle(0)), 3u) << "and are not given to others";
    scene().set_mesh(2, triangle(1));  // brought back
    scene().set_instance_mesh(2, 2);
    EXPECT_EQ(scene().triangle_count(), 3u);
    EXPECT_TRUE(scene().remove_instance(2).ok());
}

TEST_F(ChangeTracking, HidingAndShowing) {
    sent();
    scene().set_instance_mesh(0, NONE);
    EXPECT_THAT(sent(), ElementsAre("SetInstance 0"));
    scene().set_instance_mesh(2, NONE);
    EXPECT_THAT(sent(), ElementsAre("SetInstance 2", "SetLights 1"));
    scene().set_instance_mesh(0, 2);
    EXPECT_THAT(sent(), ElementsAre("SetInstance 0", "SetLights 2"));
}

TEST_F(ChangeTracking, OneLight) {
    sent();
    PunctualLight light = scene().punctual_lights()[0];
    light.position = glm::vec3(5);
    scene().set_punctual_light(0, light);
    EXPECT_THAT(sent(), ElementsAre("SetLights 2"));
}

TEST_F(ChangeTracking, OneTexture) {
    sent();
    scene().set_texture(0, build_texture(placeholder_image(), TextureRole::color));
    EXPECT_THAT(sent(), ElementsAre("SetTextures 1"));
    // A texture that something glows with takes its material and the lights along.
    CoreMaterial material = scene().materials()[2].core;
    material.emission_texture.texture = 0;
    scene().set_material(2, material);
    sent();
    Image white;
    white.width = white.height = 1;
    white.bytes = {0xFFFFFFFFu};
    scene().set_texture(0, build_texture(white, TextureRole::color));
    EXPECT_THAT(sent(), ElementsAre("SetTextures 1", "SetMaterials 2+1", "SetLights 2"));
    EXPECT_FLOAT_EQ(scene().materials()[2].core.emission_weight, 1.0f);
}

TEST_F(ChangeTracking, AConstantSkyIsNoLightButAMapIs) {
    sent();
    Sky constant;
    constant.radiance = glm::vec3(1);
    scene().set_sky(constant);
    EXPECT_THAT(sent(), ElementsAre("SetSkyData"));
    EXPECT_EQ(log_->sky_probability, 0.0f);
    scene().set_sky(sky_map(2.0f));
    EXPECT_THAT(sent(), ElementsAre("SetLights 3", "SetSkyData"));
    EXPECT_GT(log_->sky_probability, 0.0f);
    const float before = log_->sky_probability;
    // Another light's weight changes the sky's share, which the sky carries.
    PunctualLight light = scene().punctual_lights()[0];
    light.emission = glm::vec3(100);
    scene().set_punctual_light(0, light);
    EXPECT_THAT(sent(), ElementsAre("SetLights 3", "SetSkyData"));
    EXPECT_LT(log_->sky_probability, before);
}

TEST_F(ChangeTracking, ASkyMapsWeightFollowsTheSizeOfTheScene) {
    scene().set_sky(sky_map(2.0f));
    sent();
    scene().set_instance_transform(1, moved(1.5f));  // inside the box: the radius stays
    EXPECT_THAT(sent(), ElementsAre("SetInstance 1"));
    const float before = log_->total_weight;
    scene().set_instance_transform(0, moved(50));
    EXPECT_THAT(sent(), ElementsAre("SetInstance 0", "SetLights 3", "SetSkyData"));
    EXPECT_GT(log_->total_weight, before);
}

TEST_F(ChangeTracking, ANodeMovesWhatHangsBelow) {
    HostNode root;
    root.instance = 0;
    const uint32_t top = scene().add_node(root);
    HostNode child;
    child.parent = top;
    child.instance = 1;
    scene().add_node(child);
    HostNode apart;
    apart.instance = 2;
    scene().add_node(apart);
    sent();
    glm::dmat4 matrix(1.0);
    matrix[3] = {4, 5, 6, 1};
    scene().set_node_transform(top, matrix);
    EXPECT_THAT(sent(), ElementsAre("SetInstance 0", "SetInstance 1"));
    EXPECT_EQ(scene().instances()[1].transform.rows[1].w, 5.0f);
}

TEST_F(ChangeTracking, WhatIsAddedGoesWithWhatItTouches) {
    sent();
    const uint32_t material = scene().add_material(HostMaterial());
    const uint32_t mesh = scene().add_mesh(triangle(material));
    scene().add_instance(mesh, moved(3));
    EXPECT_THAT(sent(), ElementsAre("SetMaterials 3+1", "SetGeometry 3", "SetInstance 3"));
}

TEST_F(ChangeTracking, AnEditRestartsTheNextPicture) {
    const ViewPyramid view;
    ASSERT_TRUE(system_.render(view, Convergence::Converge, 1).ok());
    EXPECT_EQ(log_->last_convergence, Convergence::Restart);
    ASSERT_TRUE(system_.render(view, Convergence::Converge, 1).ok());
    EXPECT_EQ(log_->last_convergence, Convergence::Converge);
    scene().set_instance_transform(0, moved(2));
    log_->render_status = Status::error(StatusCode::device_lost, "gone");
    EXPECT_FALSE(system_.render(view, Convergence::Converge, 1).ok());
    log_->render_status = Status::success();
    ASSERT_TRUE(system_.render(view, Convergence::Converge, 1).ok());
    EXPECT_EQ(log_->last_convergence, Convergence::Restart);  // the failed one does not count
}

TEST_F(ChangeTracking, WhatACoreRefusedIsSentAgain) {
    sent();
    scene().set_mesh(0, triangle(0));
    scene().set_mesh(1, triangle(1));
    log_->geometry_status = Status::out_of_memory("full", 2, 1);
    EXPECT_EQ(system_.synchronize().code, StatusCode::out_of_memory);
    log_->geometry_status = Status::success();
    EXPECT_THAT(sent(), ElementsAre("SetGeometry 0", "SetGeometry 1"));
}

TEST(RenderSystem, WithoutACoreNothingCanBeRendered) {
    RenderSystem system{HostScene()};
    EXPECT_EQ(system.render(ViewPyramid(), Convergence::Restart, 1).code, StatusCode::wrong_order);
}

}  // namespace
}  // namespace render_system::testing::change_tracking_test
