// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "tests/render_system/gltf_file.h"

namespace render_system::testing::loader_node_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A file whose nodes are just these; the scene's roots are `roots`.
GltfFile with_nodes(const json& nodes, const json& roots) {
    GltfFile file = one_triangle();
    file.root["nodes"] = nodes;
    file.root["scenes"][0]["nodes"] = roots;
    return file;
}

void expect_near(const glm::vec3& got, const glm::vec3& wanted) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], 1e-5f) << "component " << i;
}

TEST(LoaderNode, AppliesScaleThenRotationThenTranslation) {
    const float h = std::sqrt(0.5f);
    const HostScene scene = loaded(with_nodes({{{"mesh", 0},
                                                {"translation", {10, 20, 30}},
                                                {"rotation", {0, 0, h, h}},  // a quarter turn about z
                                                {"scale", {2, 3, 4}}}},
                                              {0}));
    const CoreTransform& t = scene.instances()[0].transform;
    expect_near(transform_point(t, {1, 0, 0}), {10, 22, 30});
    expect_near(transform_point(t, {0, 1, 0}), {7, 20, 30});
    expect_near(transform_point(t, {0, 0, 1}), {10, 20, 34});
}

TEST(LoaderNode, ReadsMatricesByColumns) {
    const HostScene scene =
        loaded(with_nodes({{{"mesh", 0}, {"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1}}}}, {0}));
    const CoreTransform& t = scene.instances()[0].transform;
    EXPECT_EQ(transform_point(t, {1, 0, 0}), glm::vec3(5, 8, 7));
    EXPECT_EQ(transform_point(t, {0, 1, 0}), glm::vec3(2, 6, 7));
    EXPECT_EQ(transform_point(t, {0, 0, 1}), glm::vec3(5, 6, 11));
}

TEST(LoaderNode, ChainsParentsAndChildrenWhateverTheirOrder) {
    // 2 -> 0 -> 1; the mesh hangs on the last.
    const HostScene scene = loaded(with_nodes({{{"translation", {0, 1, 0}}, {"children", {1}}},
                                               {{"mesh", 0}, {"translation", {0, 0, 1}}},
                                               {{"scale", {-2, 1, 1}}, {"translation", {1, 0, 0}}, {"children", {0}}}},
                                              {2}));
    ASSERT_EQ(scene.instances().size(), 1u);
    EXPECT_EQ(transform_point(scene.instances()[0].transform, {1, 0, 0}), glm::vec3(-1, 1, 1));
    ASSERT_EQ(scene.nodes().size(), 3u);
    for (uint32_t i = 0; i < 3; ++i) {
        EXPECT_TRUE(scene.nodes()[i].parent == NONE || scene.nodes()[i].parent < i);
    }
}

TEST(LoaderNode, OneMeshUnderManyNodesIsKeptOnce) {
    json nodes = json::array();
    json roots = json::array();
    for (int i = 0; i < 5; ++i) {
        nodes.push_back({{"mesh", 0}, {"translation", {i, 0, 0}}});
        roots.push_back(4 - i);
    }
    const HostScene scene = loaded(with_nodes(nodes, roots));
    EXPECT_EQ(scene.meshes().size(), 1u);
    ASSERT_EQ(scene.instances().size(), 5u);
    EXPECT_EQ(scene.triangle_count(), 5u);
    for (size_t i = 0; i < 5; ++i) {  // in node order, not in that of the scene
        EXPECT_EQ(scene.instances()[i].mesh, 0u);
        EXPECT_EQ(scene.instances()[i].transform.rows[0].w, static_cast<float>(i));
    }
}

TEST(LoaderNode, RefusesCyclesAndSharedChildren) {
    const json a = {{"mesh", 0}, {"children", {1}}};
    EXPECT_THAT(refusal(with_nodes({a, {{"children", {0}}}}, {0})), HasSubstr("/nodes/0: is reached twice"));
    EXPECT_THAT(refusal(with_nodes({{{"children", {0}}}}, {0})), HasSubstr("/nodes/0: is reached twice"));
    EXPECT_THAT(refusal(with_nodes({{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}}, {0, 1})),
                HasSubstr("/nodes/2: is reached twice"));
}

TEST(LoaderNode, FollowsDeepHierarchies) {
    json nodes = json::array();
    const int depth = 20000;
    for (int i = 0; i < depth; ++i) nodes.push_back({{"translation", {0, 0, 1}}, {"children", {i + 1}}});
    nodes.push_back({{"mesh", 0}});
    const HostScene scene = loaded(with_nodes(nodes, {0}));
    EXPECT_EQ(scene.instances()[0].transform.rows[2].w, static_cast<float>(depth));
}

TEST(LoaderNode, ShowsTheDefaultSceneOrTheFirst) {
    GltfFile file = with_nodes({{{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}}, {0});
    file.root["scenes"].push_back({{"nodes", {1}}});
    file.root["scene"] = 1;
    EXPECT_EQ(loaded(file).instances()[0].transform.rows[0].w, 5.0f);
    file.root.erase("scene");
    EXPECT_EQ(loaded(file).instances()[0].transform.rows[0].w, 0.0f);
}

TEST(LoaderNode, LeavesOutInstancesWithoutExtentAndSaysSo) {
    std::vector<std::string> warnings;
    const HostScene scene = loaded(with_nodes({{{"mesh", 0}}, {{"mesh", 0}, {"scale", {1, 0, 1}}}}, {0, 1}), &warnings);
    EXPECT_EQ(scene.triangle_count(), 1u);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("instances scaled to nothing (/nodes/1)")));
}

TEST(LoaderNode, ReadsPerspectiveCamerasInNodeOrder) {
    GltfFile file = with_nodes({{{"mesh", 0}},
                                {{"name", "second"}, {"camera", 0}, {"translation", {1, 2, 3}}},
                                {{"name", "third"}, {"camera", 0}, {"rotation", {0, 1, 0, 0}}, {"scale", {2, 2, 2}}}},
                               {2, 1, 0});
    file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.75}, {"znear", 0.1}}}}};
    const HostScene scene = loaded(file);
    ASSERT_EQ(scene.cameras().size(), 2u);
    EXPECT_EQ(scene.cameras()[0].name, "second");
    EXPECT_EQ(scene.cameras()[0].camera.position, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.cameras()[0].camera.forward, glm::vec3(0, 0, -1));
    EXPECT_EQ(scene.cameras()[0].camera.vertical_fov, 0.75f);
    EXPECT_EQ(scene.cameras()[1].name, "third");
    expect_near(scene.cameras()[1].camera.forward, {0, 0, 1});
    expect_near(scene.cameras()[1].camera.right, {-1, 0, 0});
    expect_near(scene.cameras()[1].camera.up, {0, 1, 0});
}

TEST(LoaderNode, ReadsOrthographicCameras) {
    GltfFile file =
        with_nodes({{{"mesh", 0}}, {{"camera", 0}, {"translation", {1, 2, 3}}, {"scale", {5, 5, 5}}}}, {0, 1});
    file.root["cameras"] = {
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 9}, {"ymag", 1.5}, {"zfar", 9}, {"znear", 0}}}}};
    const HostScene scene = loaded(file);
    ASSERT_EQ(scene.cameras().size(), 1u);
    EXPECT_EQ(scene.cameras()[0].camera.parallel_height, 3.0f);
    EXPECT_EQ(scene.cameras()[0].camera.position, glm::vec3(1, 2, 3));
    file.root["cameras"][0]["orthographic"]["ymag"] = 0;
    EXPECT_THAT(refusal(file), HasSubstr("/cameras/0/orthographic/ymag: must not be 0"));
}

TEST(LoaderNode, NamesEverythingUnsupportedInOneWarning) {
    GltfFile file = with_nodes({{{"mesh", 0}, {"skin", 0}}, {{"camera", 0}}, {{"camera", 1}}}, {0, 1, 2});
    file.root["cameras"] = {
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 9}, {"znear", 0}}}},
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    file.root["skins"] = {{{"joints", {0}}}};
    file.root["animations"] = {{{"channels", json::array()}, {"samplers", json::array()}}};
    file.root["extensionsUsed"] = {"KHR_materials_dispersion", "KHR_texture_transform"};
    json& primitive = file.root["meshes"][0]["primitives"][0];
    json lines = primitive;
    lines["mode"] = 1;
    file.root["meshes"][0]["primitives"].push_back(lines);
    std::vector<std::string> warnings;
    const HostScene scene = loaded(file, &warnings);
    EXPECT_EQ(scene.cameras().size(), 2u);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_THAT(
        warnings[0],
        AllOf(HasSubstr("animations without channels (/animations/0)"), HasSubstr("extension KHR_materials_dispersion"),
              HasSubstr("lines (/meshes/0/primitives/1)"), HasSubstr("skins of what has no joints (/nodes/0)")));
    EXPECT_THAT(warnings[0], ::testing::Not(HasSubstr("KHR_texture_transform")));
}

json light_node(int light, const json& more) {
    json node = more;
    node["extensions"]["KHR_lights_punctual"]["light"] = light;
    return node;
}

TEST(LoaderNode, ReadsPunctualLights) {
    const float h = std::sqrt(0.5f);
    GltfFile file = with_nodes({{{"mesh", 0}},
                                light_node(2, {{"translation", {1, 2, 3}}}),
                                light_node(0, {{"rotation", {-h, 0, 0, h}}, {"scale", {3, 3, 3}}}),
                                light_node(1, {{"translation", {0, 5, 0}}})},
                               {0, 1, 2, 3});
    file.root["extensionsUsed"] = {"KHR_lights_punctual"};
    file.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 3}, {"color", {1, 0.5, 0}}},
        {{"type", "point"}, {"name", "bulb"}, {"intensity", 2000000000}, {"range", 9}},
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}}};
    std::vector<std::string> warnings;
    const HostScene scene = loaded(file, &warnings);
    ASSERT_EQ(scene.punctual_lights().size(), 3u);
    const PunctualLight& spot = scene.punctual_lights()[0];
    EXPECT_EQ(spot.kind, LightKind::spot);
    EXPECT_EQ(spot.position, glm::vec3(1, 2, 3));
    EXPECT_EQ(spot.direction, glm::vec3(0, 0, -1));
    EXPECT_EQ(spot.emission, glm::vec3(1));
    EXPECT_EQ(spot.inner_cone, 0.25f);
    EXPECT_EQ(spot.outer_cone, 0.5f);
    const PunctualLight& sun = scene.punctual_lights()[1];
    EXPECT_EQ(sun.kind, LightKind::directional);
    expect_near(sun.direction, {0, -1, 0});
    EXPECT_EQ(sun.emission, glm::vec3(3, 1.5f, 0));
    const PunctualLight& bulb = scene.punctual_lights()[2];
    EXPECT_EQ(bulb.kind, LightKind::point);
    EXPECT_EQ(bulb.name, "bulb");
    EXPECT_EQ(bulb.emission, glm::vec3(2e9f));
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("ranges of lights (/extensions/KHR_lights_punctual/lights/1)")));
}

TEST(LoaderNode, ASpotWithoutConesHasTheExtensionsDefaults) {
    GltfFile file = with_nodes({{{"mesh", 0}}, light_node(0, json::object())}, {0, 1});
    file.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", json::object()}}};
    const HostScene scene = loaded(file);
    EXPECT_EQ(scene.punctual_lights()[0].inner_cone, 0.0f);
    EXPECT_FLOAT_EQ(scene.punctual_lights()[0].outer_cone, 0.78539816f);
}

TEST(LoaderNode, SaysWhereFloatsAreTooFewForTheSceneInItsPlace) {
    const auto said = [](float size, const json& place) {
        GltfFile file = one_triangle();
        file.root["nodes"][0]["translation"] = place;
        file.root["nodes"][0]["scale"] = {size, size, size};
        std::vector<std::string> warnings;
        loaded(file, &warnings);
        return warnings;
    };
    EXPECT_THAT(said(6, {3, 1e7, 0}),
                ElementsAre(HasSubstr("is 6 wide and lies at coordinates of 1e+07, where floats are "
                                      "1 apart: its light will be wrong; move it to the origin")));
    EXPECT_EQ(said(600, {0, 0, -1e8}).size(), 1u);
    EXPECT_TRUE(said(6, {1e5, 1e5, 1e5}).empty());
    EXPECT_TRUE(said(600, {3, 1e7, 0}).empty());
    EXPECT_TRUE(said(1e-6f, {0, 0, 0}).empty());
    EXPECT_TRUE(said(1e8f, {1e8, 0, 0}).empty());
}

}  // namespace
}  // namespace render_system::testing::loader_node_test
