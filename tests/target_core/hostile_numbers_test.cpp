// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0

// Numbers that Embree ends the process over, or that leave no picture: scenes with some of their numbers exchanged for
// huge, tiny, denormal, infinite ones and none at all are refused or rendered, to the last pixel a number.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "render_system/render_system.h"
#include "render_system/scene_limits.h"
#include "target_core/render_core.h"
#include "tests/render_system/gltf_file.h"

namespace render_system::testing::hostile_numbers_test {
namespace {

using nlohmann::json;

constexpr uint32_t kSide = 8;

// Two instances of one mesh, one placed mesh, an emitter, two lights, glass and metal: all ways into Embree.
GltfFile seed_file() {
    GltfFile file;
    const int positions = file.add(std::vector<glm::vec3>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0.5f}, {-1, 1, 0}});
    const int normals = file.add(std::vector<glm::vec3>(4, glm::vec3(0, 0, 1)));
    const int uvs = file.add(std::vector<glm::vec2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    const int indices = file.add(std::vector<uint16_t>{0, 1, 2, 0, 2, 3});
    const int texture = file.add_texture(png_uri(2, 2, 3, std::vector<uint8_t>(12, 200)));
    const json transform = {{"offset", {0.5, 0.25}}, {"rotation", 1.0}, {"scale", {2.0, 2.0}}};
    const json info = {{"index", texture}, {"extensions", {{"KHR_texture_transform", transform}}}};
    file.add_material({{"pbrMetallicRoughness",
                        {{"baseColorFactor", {0.5, 0.5, 0.5, 0.5}},
                         {"baseColorTexture", info},
                         {"metallicFactor", 0.5},
                         {"roughnessFactor", 0.5}}},
                       {"normalTexture", {{"index", texture}, {"scale", 1.0}}},
                       {"alphaMode", "BLEND"}});
    file.add_material({{"emissiveFactor", {1.0, 1.0, 1.0}},
                       {"alphaMode", "MASK"},
                       {"alphaCutoff", 0.5},
                       {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5.0}}}}}});
    file.add_material(
        {{"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 0.4}}},
         {"extensions",
          {{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}},
           {"KHR_materials_volume", {{"thicknessFactor", 1.0}}},
           {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1.0, 0.5, 1.0}}}},
           {"KHR_materials_ior", {{"ior", 1.4}}}}}});
    const auto primitive = [&](int material) {
        return json{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
                    {"indices", indices},
                    {"material", material}};
    };
    for (const int material : {0, 1, 2}) file.add_mesh(primitive(material));
    file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    file.root["extensionsUsed"] = {"KHR_lights_punctual"};
    file.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 3.0}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}},
        {{"type", "directional"}, {"intensity", 1.0}, {"color", {1.0, 0.5, 0.25}}}};
    const auto light = [](int number) { return json{{"KHR_lights_punctual", {{"light", number}}}}; };
    file.add_node({{"mesh", 0}, {"translation", {-1.0, 0.0, 0.0}}, {"scale", {1.0, 1.0, 1.0}}});
    file.add_node({{"mesh", 0}, {"translation", {1.0, 0.0, -1.0}}, {"rotation", {0.0, 0.6, 0.0, 0.8}}});
    file.add_node({{"mesh", 1}, {"matrix", {1.0, 0, 0, 0, 0, -1.0, 0, 0, 0, 0, -1.0, 0, 1.0, 2.0, 3.0, 1}}});
    file.add_node({{"mesh", 2}, {"translation", {0.0, 0.0, 1.0}}, {"scale", {0.5, 0.5, 0.5}}});
    file.add_node({{"camera", 0}, {"translation", {0.0, 0.0, 5.0}}});
    file.add_node({{"translation", {0.0, 3.0, 2.0}}, {"extensions", light(0)}});
    file.add_node({{"rotation", {0.6, 0.0, 0.0, 0.8}}, {"extensions", light(1)}});
    return file;
}

void collect_numbers(json& value, std::vector<json*>& all) {
    if (value.is_number_float()) all.push_back(&value);
    if (!value.is_structured()) return;
    for (json& child : value) collect_numbers(child, all);
}

// Any sign, any exponent that a float has and some more, as often as the numbers at the edges.
double odd_number(std::mt19937& dice) {
    const double edges[] = {0.0,    -0.0, 1e-45,  1e-40,   1.17549435e-38, 1e-30, 1e-19, 1e-9, 1e8,    9.99e8,
                            1.01e9, 1e12, 1.8e18, 1.85e18, 1e19,           1e30,  1e37,  3e38, 3.5e38, 1e300};
    const double sign = dice() % 2 == 0 ? 1.0 : -1.0;
    if (dice() % 2 == 0) return sign * edges[dice() % std::size(edges)];
    return sign * std::exp2(static_cast<double>(dice() % 2800) * 0.1 - 150.0);
}

void exchange_numbers(GltfFile& file, std::mt19937& dice) {
    std::vector<json*> numbers;
    for (const char* part : {"nodes", "materials", "cameras", "extensions"}) collect_numbers(file.root[part], numbers);
    for (size_t edits = 1 + dice() % 3; edits > 0; --edits) {
        if (dice() % 4 != 0) {
            *numbers[dice() % numbers.size()] = odd_number(dice);
            continue;
        }
        const auto bits = static_cast<float>(odd_number(dice));
        const float values[] = {bits, bits, bits, std::numeric_limits<float>::quiet_NaN()};
        const size_t floats = 32;  // positions, normals and uvs come first
        std::memcpy(file.buffer.data() + 4 * (dice() % floats), &values[dice() % 4], 4);
    }
}

class HostileNumbers : public ::testing::Test {
protected:
    // Answers whether a picture came of it.
    bool try_file(const GltfFile& file) {
        Result<LoadedScene> result = file.load(folder_);
        if (!result.ok()) return refused(result.status);
        HostScene& scene = result->scene;
        scene.set_sky({.radiance = glm::vec3(0.5f)});
        const Camera camera = scene.cameras().empty() ? framing_camera(scene, 1.0f) : scene.cameras()[0].camera;
        std::vector<glm::vec4> pixels(kSide * kSide, glm::vec4(0.0f));
        std::unique_ptr<CoreAPI> core = target_core::create_core();
        EXPECT_TRUE(core->Init({.threads = 1}).ok());
        EXPECT_TRUE(core->SetTarget({kSide, kSide, pixels}).ok());
        RenderSystem system(std::move(scene));
        system.use_core(std::move(core));
        const Status status = system.render(view_pyramid(camera, kSide, kSide), Convergence::Restart, 2);
        if (!status.ok()) return refused(status);
        for (const glm::vec4& pixel : pixels) {
            EXPECT_TRUE(std::isfinite(pixel.x + pixel.y + pixel.z)) << pixel.x << " " << pixel.y << " " << pixel.z;
        }
        return true;
    }

    static bool refused(const Status& status) {
        EXPECT_FALSE(status.message.empty());
        EXPECT_EQ(status.message.find('\n'), std::string::npos) << status.message;
        return false;
    }

    TempFolder folder_;
};

TEST_F(HostileNumbers, EndNoProcessAndLeaveNoPixelWithoutANumber) {
    ASSERT_TRUE(try_file(seed_file()));
    const char* more = std::getenv("PORTTOOL_FUZZ_SEED");
    const char* count = std::getenv("PORTTOOL_FUZZ_FILES");
    std::mt19937 dice(17u + static_cast<uint32_t>(more ? std::atoi(more) : 0));
    int rendered = 0;
    const int files = count ? std::atoi(count) : 300;
    for (int i = 0; i < files && !HasFailure(); ++i) {
        GltfFile file = seed_file();
        exchange_numbers(file, dice);
        rendered += try_file(file) ? 1 : 0;
        if (HasFailure()) write_file("hostile_numbers.gltf", file.text_embedded());
    }
    EXPECT_GT(rendered, files / 4);  // else all ends in the loader
}

}  // namespace
}  // namespace render_system::testing::hostile_numbers_test
