// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "render_system/animation/curve.h"
#include "render_system/animation/moving_meshes.h"
#include "tests/render_system/gltf_file.h"

namespace render_system::testing::loader_animation_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Floats = std::vector<float>;

int add_floats(GltfFile& file, const Floats& values, const std::string& type, size_t width) {
    return file.add_accessor(file.add_view(values), FLOAT, type, values.size() / width);
}

void add_channel(GltfFile& file, const Floats& times, const Floats& values, const std::string& type, size_t width,
                 const json& target, const char* interpolation = "LINEAR") {
    if (!file.root.contains("animations"))
        file.root["animations"] = {{{"channels", json::array()}, {"samplers", json::array()}}};
    json& animation = file.root["animations"][0];
    animation["channels"].push_back({{"sampler", animation["samplers"].size()}, {"target", target}});
    animation["samplers"].push_back({{"input", add_floats(file, times, "SCALAR", 1)},
                                     {"output", add_floats(file, values, type, width)},
                                     {"interpolation", interpolation}});
}

json pointer(const std::string& text) {
    return {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", text}}}}}};
}

json part(int node, const char* path) { return {{"node", node}, {"path", path}}; }

Curve curve_of(Interpolation interpolation, uint32_t width, const Floats& times, const Floats& values) {
    return {interpolation, width == 4, width, std::make_shared<const Floats>(times),
            std::make_shared<const Floats>(values)};
}

double at(const Curve& curve, double time, size_t i = 0) {
    std::vector<double> value;
    sample_curve(curve, time, value);
    return value[i];
}

TEST(Curve, StepsAndLinesHoldTheirEnds) {
    const Floats times = {1, 2, 4}, values = {10, 20, 60};
    const Curve steps = curve_of(Interpolation::step, 1, times, values);
    const Curve lines = curve_of(Interpolation::linear, 1, times, values);
    for (const Curve& curve : {steps, lines}) {
        EXPECT_EQ(at(curve, -5), 10);
        EXPECT_EQ(at(curve, 2), 20);
        EXPECT_EQ(at(curve, 9), 60);
    }
    EXPECT_EQ(at(steps, 1.999), 10);
    EXPECT_EQ(at(lines, 2.5), 30);
    const Curve jump = curve_of(Interpolation::linear, 1, {0, 1, 1, 2}, {0, 1, 5, 6});
    EXPECT_EQ(at(jump, 1), 5);
    EXPECT_EQ(at(curve_of(Interpolation::linear, 1, {3}, {7}), 3), 7);
}

// Hermite's spline through the values and slopes of a cubic is that cubic.
TEST(Curve, ASplineOfACubicIsTheCubic) {
    const auto cubic = [](double t) { return ((2 * t - 3) * t + 1) * t + 5; };
    const auto slope = [](double t) { return (6 * t - 6) * t + 1; };
    Floats times, values;
    for (const double t : {0.0, 0.5, 2.0}) {
        times.push_back(static_cast<float>(t));
        for (const double x : {slope(t), cubic(t), slope(t)}) values.push_back(static_cast<float>(x));
    }
    const Curve spline = curve_of(Interpolation::cubic_spline, 1, times, values);
    for (double t = 0; t <= 2; t += 0.125) EXPECT_NEAR(at(spline, t), cubic(t), 1e-12) << t;
    EXPECT_EQ(at(spline, 7), cubic(2));
}

TEST(Curve, RotationsGoAlongTheShorterArcAtAnEvenPace) {
    // From no turn to one of 120 degrees about z, and the same end with all signs turned round.
    const float s = std::sqrt(0.75f);
    for (const float sign : {1.0f, -1.0f}) {
        const Curve turn = curve_of(Interpolation::linear, 4, {0, 3}, {0, 0, 0, 1, 0, 0, sign * s, sign * 0.5f});
        for (double t = 0.25; t < 3; t += 0.25) {
            EXPECT_NEAR(at(turn, t, 2), std::sin(t * 20 * M_PI / 180), 1e-7);
            EXPECT_NEAR(at(turn, t, 3), std::cos(t * 20 * M_PI / 180), 1e-7);
        }
    }
}

HostScene played(const GltfFile& file, double time) {
    HostScene scene = loaded(file);
    EXPECT_TRUE(scene.play(time).ok());
    return scene;
}

TEST(LoaderAnimation, MovesANodeAndWhatHangsOnIt) {
    GltfFile file = one_triangle();
    file.root["nodes"][0]["translation"] = {0, 5, 0};
    file.add_node({{"children", {0}}});
    file.root["scenes"][0]["nodes"] = {1};
    add_channel(file, {0, 2}, {0, 0, 0, 4, 0, 0}, "VEC3", 3, part(1, "translation"));
    add_channel(file, {0, 2}, {1, 1, 1, 1, 3, 1}, "VEC3", 3, part(0, "scale"), "STEP");
    const auto corner = [&](double time) {
        return transform_point(played(file, time).instances()[0].transform, {0, 1, 0});
    };
    EXPECT_EQ(corner(0), glm::vec3(0, 6, 0));
    EXPECT_EQ(corner(0.5), glm::vec3(1, 6, 0));
    EXPECT_EQ(corner(2), glm::vec3(4, 8, 0));
    const TempFolder folder;
    write_file(folder / "scene.gltf", file.text_embedded());
    const auto late = load_scene(folder / "scene.gltf", {.time = 2});
    ASSERT_TRUE(late.ok());
    EXPECT_EQ(late->scene.instances()[0].transform, played(file, 2).instances()[0].transform);
}

TEST(LoaderAnimation, RaisesNoFlagOfWhatStandsStill) {
    GltfFile file = one_triangle();
    file.add_node({{"mesh", 0}});
    add_channel(file, {0, 1, 2}, {0, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3", 3, part(1, "translation"));
    HostScene scene = loaded(file);
    const auto flags = [&](double time) {
        scene.changes() = {{false}, {false, false}, {false}, false, false, false};
        EXPECT_TRUE(scene.play(time).ok());
        return std::vector<bool>{scene.changes().instances[0], scene.changes().instances[1], scene.changes().meshes[0]};
    };
    EXPECT_THAT(flags(0.5), ElementsAre(false, true, false));
    EXPECT_THAT(flags(1.25), ElementsAre(false, true, false));
    EXPECT_THAT(flags(1.75), ElementsAre(false, false, false));
}

TEST(LoaderAnimation, HidesWhatIsScaledToNothingForAsLong) {
    GltfFile file = one_triangle();
    file.add_node({{"mesh", 0}});
    add_channel(file, {0, 1, 2}, {1, 1, 1, 0, 0, 0, 1, 1, 1}, "VEC3", 3, part(1, "scale"));
    HostScene scene = loaded(file);
    for (const double time : {0.5, 1.0, 1.5, 1.0, 0.0}) {
        ASSERT_TRUE(scene.play(time).ok());
        EXPECT_EQ(scene.triangle_count(), time == 1.0 ? 1u : 2u) << time;
    }
}

// What a user gives an instance to show counts whether it can be seen just then or not.
TEST(LoaderAnimation, AnInstanceKeepsTheMeshThatItWasGivenWhileItIsScaledToNothing) {
    GltfFile file = one_triangle();
    file.add_node({{"mesh", 0}});
    add_channel(file, {0, 1, 2}, {1, 1, 1, 0, 0, 0, 1, 1, 1}, "VEC3", 3, part(1, "scale"));
    for (const double edited : {0.0, 1.0}) {
        HostScene scene = loaded(file);
        HostMesh copy = scene.meshes()[0];
        const uint32_t other = scene.add_mesh(std::move(copy));
        const auto shown = [&](double time) {
            EXPECT_TRUE(scene.play(time).ok());
            return scene.instances()[1].mesh;
        };
        shown(edited);
        scene.set_instance_mesh(1, other);
        EXPECT_EQ(scene.instances()[1].mesh, edited == 1.0 ? NONE : other);
        EXPECT_EQ(shown(1), NONE);
        EXPECT_EQ(shown(2), other);
        EXPECT_FALSE(scene.remove_mesh(other).ok());
        scene.set_instance_mesh(0, other);
        shown(1);
        EXPECT_FALSE(scene.remove_mesh(other).ok()) << "its node will show it";
        scene.set_instance_mesh(0, NONE);
        scene.set_instance_mesh(1, NONE);
        EXPECT_EQ(shown(0), NONE);
        EXPECT_TRUE(scene.remove_mesh(other).ok());
    }
}

TEST(LoaderAnimation, ASceneMayBeginWithNothingToSee) {
    GltfFile file = one_triangle();
    add_channel(file, {0, 1}, {0, 0, 0, 1, 1, 1}, "VEC3", 3, part(0, "scale"));
    std::vector<std::string> warnings;
    HostScene scene = loaded(file, &warnings);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("instances scaled to nothing (/nodes/0)")));
    EXPECT_EQ(scene.triangle_count(), 0u);
    ASSERT_TRUE(scene.play(1.0).ok());
    EXPECT_EQ(scene.triangle_count(), 1u);
}

// The triangle with two joints, of which `count` influences a vertex share the pull.
GltfFile skinned(size_t count) {
    GltfFile file = one_triangle();
    json& attributes = file.root["meshes"][0]["primitives"][0]["attributes"];
    for (size_t set = 0; set < count / 4; ++set) {
        std::vector<uint8_t> joints;
        Floats weights;
        for (int vertex = 0; vertex < 3; ++vertex) {
            for (const uint8_t joint : {0, 1, 0, 1}) joints.push_back(joint);
            weights.insert(weights.end(), 4, 1.0f / static_cast<float>(count));
        }
        const std::string number = std::to_string(set);
        attributes["JOINTS_" + number] = file.add_accessor(file.add_view(joints), UBYTE, "VEC4", 3);
        attributes["WEIGHTS_" + number] = add_floats(file, weights, "VEC4", 4);
    }
    file.root["nodes"][0]["skin"] = 0;
    file.root["nodes"][0]["translation"] = {100, 0, 0};  // does not count
    const float h = std::sqrt(0.5f);
    file.add_node({{"translation", {0, 0, 2}}});
    file.add_node({{"translation", {0, 0, 4}}, {"rotation", {0, h, 0, h}}});  // a quarter turn about y: x to -z
    const Floats binds = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1,
                          1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1};
    file.root["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", add_floats(file, binds, "MAT4", 16)}}};
    return file;
}

void expect_near(const glm::vec3& got, const glm::vec3& wanted) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], 1e-6f) << "component " << i;
}

TEST(LoaderAnimation, SkinsByFourAndByEightJointsAVertex) {
    for (const size_t count : {4, 8}) {
        HostScene scene = loaded(skinned(count));
        ASSERT_EQ(scene.instances()[0].transform, CoreTransform());
        // The mean of p + (0,0,3) and of its quarter turn: (x,y,z+1) goes to (z+1,y,4-x).
        const HostMesh& mesh = scene.meshes()[scene.instances()[0].mesh];
        expect_near(mesh.positions[0], {0.5f, 0, 3.5f});
        expect_near(mesh.positions[1], {1, 0, 3});
        expect_near(mesh.positions[2], {0.5f, 1, 3.5f});
        expect_near(mesh.normals[0], {std::sqrt(0.5f), 0, std::sqrt(0.5f)});
        scene.changes().meshes.assign(1, false);
        scene.set_node_transform(1, glm::dmat4(1.0));  // a joint by hand: the mesh follows
        expect_near(mesh.positions[0], {0.5f, 0, 2.5f});
        EXPECT_TRUE(scene.changes().meshes[0]);
    }
}

TEST(LoaderAnimation, MorphsByTheWeightsOfNodeMeshAndAnimation) {
    GltfFile file = one_triangle();
    const int up = file.add(std::vector<glm::vec3>(3, glm::vec3(0, 0, 2)));
    const int tilt = file.add(std::vector<glm::vec3>(3, glm::vec3(1, 0, 0)));
    file.root["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", up}}, {{"NORMAL", tilt}}};
    file.root["meshes"][0]["weights"] = {0.5, 0};
    const auto mesh = [](const HostScene& scene) { return scene.meshes()[scene.instances()[0].mesh]; };
    EXPECT_EQ(mesh(loaded(file)).positions[1], glm::vec3(1, 0, 1));
    file.root["nodes"][0]["weights"] = {0, 1};
    EXPECT_EQ(mesh(loaded(file)).positions[1], glm::vec3(1, 0, 0));
    expect_near(mesh(loaded(file)).normals[1], {std::sqrt(0.5f), 0, std::sqrt(0.5f)});
    add_channel(file, {0, 1}, {0, 0, 1, 0}, "SCALAR", 1, part(0, "weights"));
    EXPECT_EQ(mesh(played(file, 0.75)).positions[1], glm::vec3(1, 0, 1.5f));
}

TEST(LoaderAnimation, TellsWhichMeshesMoveAndWhichDeform) {
    const auto told = [](const GltfFile& file) {
        const MovingMeshes meshes = moving_meshes(loaded(file));
        return std::vector<bool>{meshes.moves.at(0), meshes.deforms.at(0)};
    };
    GltfFile file = one_triangle();
    file.add_node({{"children", {0}}});
    file.add_node({{"name", "apart"}});
    file.root["scenes"][0]["nodes"] = {1, 2};
    EXPECT_THAT(told(file), ElementsAre(false, false));
    GltfFile apart = file;
    add_channel(apart, {0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3", 3, part(2, "translation"));
    EXPECT_THAT(told(apart), ElementsAre(false, false));
    add_channel(file, {0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3", 3, part(1, "translation"));
    EXPECT_THAT(told(file), ElementsAre(true, false)) << "what hangs on a node goes with it";

    GltfFile morph = one_triangle();
    const int up = morph.add(std::vector<glm::vec3>(3, glm::vec3(0, 0, 2)));
    morph.root["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", up}}};
    EXPECT_THAT(told(morph), ElementsAre(false, false));
    add_channel(morph, {0, 1}, {0, 1}, "SCALAR", 1, part(0, "weights"));
    EXPECT_THAT(told(morph), ElementsAre(false, true));

    GltfFile skin = skinned(4);
    EXPECT_THAT(told(skin), ElementsAre(false, false));
    add_channel(skin, {0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3", 3, part(2, "translation"));
    EXPECT_THAT(told(skin), ElementsAre(false, true));
}

TEST(LoaderAnimation, AMeshThatIsGivenAnotherShapeIsDeformedNoMore) {
    HostScene scene = loaded(skinned(4));
    const uint32_t mesh = scene.instances()[0].mesh;
    HostMesh other = scene.meshes()[mesh];
    other.positions.assign(6, glm::vec3(1, 2, 3));
    other.normals.assign(6, glm::vec3(0, 0, 1));
    other.triangles = {{3, 4, 5, 0}};
    scene.set_mesh(mesh, other);
    scene.set_node_transform(1, glm::dmat4(1.0));
    EXPECT_EQ(scene.meshes()[mesh].positions, other.positions);
}

TEST(LoaderAnimation, FlatTrianglesAreFlatWhereTheyAreThen) {
    GltfFile file = one_triangle();
    json& primitive = file.root["meshes"][0]["primitives"][0];
    primitive["attributes"].erase("NORMAL");
    const int lift = file.add(std::vector<glm::vec3>{{0, 0, 0}, {0, 0, 1}, {0, 0, 0}});
    primitive["targets"] = {{{"POSITION", lift}}};
    file.root["meshes"][0]["weights"] = {1};
    const HostScene scene = loaded(file);
    expect_near(scene.meshes()[0].normals[2], {-std::sqrt(0.5f), 0, std::sqrt(0.5f)});
}

TEST(LoaderAnimation, PointersMoveMaterialsLightsAndLensesAsIfTheFileHadTheValues) {
    GltfFile file = textured_triangle();
    const int texture = file.add_texture(png_uri(1, 1, 3, {255, 0, 0}));
    const json transform = {{"offset", {0.25, 0}}, {"scale", {2, 2}}};
    file.add_material(
        {{"emissiveFactor", {0, 0, 0}},
         {"emissiveTexture", {{"index", texture}, {"extensions", {{"KHR_texture_transform", transform}}}}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 3}}}}}});
    file.root["meshes"][0]["primitives"][0]["material"] = 0;
    file.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}, {"color", {1, 0.5, 0.25}}}};
    file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    file.add_node({{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    GltfFile fixed = file;
    json& material = fixed.root["materials"][0];
    material["emissiveFactor"] = {0.5, 0.25, 0};
    material["emissiveTexture"]["extensions"]["KHR_texture_transform"]["rotation"] = 0.75;
    material["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 1, 1, 1};
    material["pbrMetallicRoughness"]["roughnessFactor"] = 0.25;
    fixed.root["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 6;
    fixed.root["cameras"][0]["perspective"]["yfov"] = 0.75;
    const auto move = [&](const std::string& property, const std::string& type, size_t width, const Floats& values) {
        add_channel(file, {0, 1}, values, type, width, pointer(property));
    };
    move("/materials/0/emissiveFactor", "VEC3", 3, {0, 0, 0, 1, 0.5, 0});
    move("/materials/0/emissiveTexture/extensions/KHR_texture_transform/rotation", "SCALAR", 1, {0, 1.5});
    move("/materials/0/pbrMetallicRoughness/baseColorFactor", "VEC4", 4, {0, 1, 1, 1, 1, 1, 1, 1});
    move("/materials/0/pbrMetallicRoughness/roughnessFactor", "SCALAR", 1, {-0.5, 1});
    move("/extensions/KHR_lights_punctual/lights/0/intensity", "SCALAR", 1, {2, 10});
    move("/cameras/0/perspective/yfov", "SCALAR", 1, {0.5, 1});
    const HostScene moved = played(file, 0.5), still = loaded(fixed);
    EXPECT_EQ(moved.materials()[0].core, still.materials()[0].core);
    EXPECT_EQ(moved.punctual_lights()[0].emission, glm::vec3(6, 3, 1.5));
    EXPECT_EQ(moved.cameras()[0].camera.vertical_fov, 0.75f);
    EXPECT_EQ(played(file, 0).materials()[0].core.roughness, 0.0f) << "values are held to their range";
}

TEST(LoaderAnimation, WhatItMovesTooFarIsRefusedWithItsNode) {
    GltfFile file = one_triangle();
    add_channel(file, {0, 1}, {1e20f, 0, 0, 0, 0, 0}, "VEC3", 3, part(0, "translation"));
    EXPECT_THAT(refusal(file), AllOf(HasSubstr("/nodes/0"), HasSubstr("reaches to a coordinate of 1e+20")));
}

TEST(LoaderAnimation, OfTwoAnimationsThatMoveTheSameTheFirstCounts) {
    GltfFile file = one_triangle();
    add_channel(file, {0}, {1, 0, 0}, "VEC3", 3, part(0, "translation"));
    file.root["animations"].push_back(file.root["animations"][0]);
    file.root["animations"][1]["samplers"][0]["output"] = file.add(std::vector<glm::vec3>{{9, 9, 9}});
    std::vector<std::string> warnings;
    const HostScene scene = loaded(file, &warnings);
    EXPECT_EQ(scene.instances()[0].transform.rows[0].w, 1.0f);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_THAT(warnings[0], HasSubstr("animations of what another moves already (/animations/1)"));
    file.root["animations"][1]["name"] = "jump";
    const TempFolder folder;
    write_file(folder / "scene.gltf", file.text_embedded());
    for (const char* name : {"jump", "1"}) {
        const auto jump = load_scene(folder / "scene.gltf", {.animation = name});
        ASSERT_TRUE(jump.ok());
        EXPECT_THAT(jump->warnings, ::testing::IsEmpty());
        EXPECT_EQ(jump->scene.instances()[0].transform.rows[0].w, 9.0f);
    }
    EXPECT_THAT(load_scene(folder / "scene.gltf", {.animation = "run"}).status.message,
                HasSubstr("there is no animation \"run\"; the file has 0, 1 \"jump\"; give one"));
}

TEST(LoaderAnimation, RefusesKeysThatAreNone) {
    const auto refused = [](const Floats& times, const Floats& values, const char* interpolation = "LINEAR") {
        GltfFile file = one_triangle();
        add_channel(file, times, values, "VEC3", 3, part(0, "translation"), interpolation);
        return refusal(file);
    };
    EXPECT_THAT(refused({}, {}), HasSubstr("/animations/0/channels/0: its sampler has no keys"));
    EXPECT_THAT(refused({0, 2, 1}, Floats(9, 0)), HasSubstr("key 2 is at 1.000000 s, before the one before it"));
    EXPECT_THAT(refused({0, NAN}, Floats(6, 0)), HasSubstr("element 1 is not finite"));
    EXPECT_THAT(refused({0, 1}, {0, 0, 0, 0, INFINITY, 0}), HasSubstr("element 1 is not finite"));
    EXPECT_THAT(refused({0, 1}, Floats(3, 0)), HasSubstr("has 2 keys, which need 6 numbers, but /accessors/3 has 3"));
    EXPECT_THAT(refused({0, 1}, Floats(6, 0), "CUBICSPLINE"), HasSubstr("need 18 numbers"));
    GltfFile file = one_triangle();
    add_channel(file, {0}, {0, 0, 0}, "VEC3", 3, part(0, "translation"));
    file.root["animations"][0]["channels"][0]["sampler"] = 1;
    EXPECT_THAT(refusal(file), HasSubstr("/animations/0/channels/0/sampler: is 1, but the animation has 1 samplers"));
    file.root["animations"][0]["channels"][0] = {{"sampler", 0}, {"target", pointer("/materials/7/alphaCutoff")}};
    EXPECT_THAT(refusal(file), HasSubstr("points at /materials/7/alphaCutoff, but there are 0"));
}

TEST(LoaderAnimation, ARotationByNothingTurnsNothingAndIsNamed) {
    const auto named = [](const Floats& keys, const char* interpolation) {
        GltfFile file = one_triangle();
        add_channel(file, {0, 1}, keys, "VEC4", 4, part(0, "rotation"), interpolation);
        std::vector<std::string> warnings;
        const HostScene scene = loaded(file, &warnings);
        EXPECT_EQ(transform_point(scene.instances()[0].transform, {0, 1, 0}), glm::vec3(0, 1, 0));
        return warnings;
    };
    const Floats turns_nothing = {0, 0, 0, 1}, is_nothing = {0, 0, 0, 0};
    const auto keys = [](std::initializer_list<Floats> parts) {
        Floats all;
        for (const Floats& part : parts) all.insert(all.end(), part.begin(), part.end());
        return all;
    };
    for (const auto& warnings :
         {named(keys({is_nothing, turns_nothing}), "LINEAR"), named(keys({turns_nothing, is_nothing}), "STEP"),
          named(keys({turns_nothing, is_nothing, turns_nothing, is_nothing, turns_nothing, is_nothing}),
                "CUBICSPLINE")}) {
        ASSERT_EQ(warnings.size(), 1u);
        EXPECT_THAT(warnings[0], HasSubstr("mended: rotations by 0, 0, 0, 0, which were made to turn nothing"));
        EXPECT_THAT(warnings[0], HasSubstr("/animations/0/channels/0"));
    }
    // The tangents of a spline may well be nothing.
    EXPECT_THAT(
        named(keys({is_nothing, turns_nothing, is_nothing, is_nothing, turns_nothing, is_nothing}), "CUBICSPLINE"),
        ::testing::IsEmpty());
}

TEST(LoaderAnimation, RefusesSkinsThatCannotHold) {
    const auto refused = [](const std::function<void(GltfFile&)>& damage) {
        GltfFile file = skinned(4);
        damage(file);
        return refusal(file);
    };
    const auto attributes = [](GltfFile& file) -> json& {
        return file.root["meshes"][0]["primitives"][0]["attributes"];
    };
    EXPECT_THAT(refused([](GltfFile& file) { file.root["skins"][0].erase("joints"); }),
                HasSubstr("/skins/0/joints: is missing"));
    EXPECT_THAT(refused([](GltfFile& file) { file.root["skins"][0]["joints"] = json::array(); }),
                HasSubstr("has no skeleton"));
    EXPECT_THAT(refused([](GltfFile& file) { file.root["skins"][0]["skeleton"] = 999; }),
                HasSubstr("/skins/0/skeleton: "));
    EXPECT_THAT(refused([](GltfFile& file) { file.root["skins"][0]["joints"] = {1}; }),
                HasSubstr("/nodes/0/skin: has 1 joints, but the mesh names joint 1"));
    EXPECT_THAT(refused([](GltfFile& file) {
                    file.root["scenes"][0]["nodes"] = {0, 1};
                }),
                HasSubstr("/skins/0/joints: names node 2, which is not in the scene"));
    EXPECT_THAT(
        refused([&](GltfFile& file) { attributes(file)["WEIGHTS_0"] = add_floats(file, Floats(12, NAN), "VEC4", 4); }),
        HasSubstr("not finite"));
    EXPECT_THAT(
        refused([&](GltfFile& file) { attributes(file)["WEIGHTS_0"] = add_floats(file, Floats(12, -1), "VEC4", 4); }),
        HasSubstr("WEIGHTS_0: vertex 0 has a weight of -1"));
    EXPECT_THAT(refused([](GltfFile& file) {
                    file.root["nodes"][1]["translation"] = {1e20, 0, 0};
                }),
                AllOf(HasSubstr("/nodes/0"), HasSubstr("reaches to a coordinate of")));
    EXPECT_THAT(refused([&](GltfFile& file) { attributes(file).erase("WEIGHTS_0"); }), HasSubstr("but no WEIGHTS_0"));
    EXPECT_THAT(
        refused([&](GltfFile& file) { attributes(file)["JOINTS_0"] = add_floats(file, Floats(12, 0), "VEC4", 4); }),
        HasSubstr("JOINTS_0: must hold unsigned bytes or shorts"));
    GltfFile heavy = skinned(4);
    for (const float weight : {0.5f, 3e38f}) {  // four of the latter are past the range of a float
        attributes(heavy)["WEIGHTS_0"] = add_floats(heavy, Floats(12, weight), "VEC4", 4);
        std::vector<std::string> warnings;
        const HostScene scene = loaded(heavy, &warnings);
        EXPECT_THAT(warnings[0], HasSubstr("mended: weights of joints that do not add up to 1"));
        expect_near(scene.meshes()[0].positions[0], {0.5f, 0, 3.5f});
    }
}

}  // namespace
}  // namespace render_system::testing::loader_animation_test
