// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/light_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render_system/scene_loader.h"
#include "render_system/texture.h"

namespace render_system::testing::light_table_test {
namespace {

constexpr double PI = 3.14159265358979323846;

// A right triangle of area 2 in the plane z = 0, front to +z, with that material.
HostMesh triangle(uint32_t material) {
    HostMesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    mesh.normals.assign(3, glm::vec3(0, 0, 1));
    mesh.uv0 = {{0, 0}, {1, 0}, {0, 1}};
    mesh.triangles = {{0, 1, 2, material}};
    return mesh;
}

HostMaterial emitter(const glm::vec3& emission) {
    HostMaterial material;
    material.core.emission = emission;
    return material;
}

CoreTransform scaled(float x, float y, float z) {
    return core_transform(glm::dmat4({x, 0, 0, 0}, {0, y, 0, 0}, {0, 0, z, 0}, {5, 6, 7, 1}));
}

glm::vec3 front(const CoreLight& light) {
    return glm::cross(light.vertices[1] - light.vertices[0], light.vertices[2] - light.vertices[0]);
}

TEST(LightTable, PutsEmissiveTrianglesIntoWorldSpaceByInstance) {
    HostScene scene;
    const uint32_t glowing = scene.add_material(emitter({1, 1, 1}));
    const uint32_t dark = scene.add_material(HostMaterial());
    HostMesh mesh = triangle(glowing);
    mesh.triangles.push_back({0, 1, 2, dark});
    const uint32_t id = scene.add_mesh(mesh);
    scene.add_instance(id, scaled(1, 1, 1));
    scene.add_instance(id, scaled(3, 2, 1));
    scene.add_instance(NONE, scaled(1, 1, 1));
    const LightTable table = build_light_table(scene, 0.0);
    ASSERT_EQ(table.lights.size(), 2u);
    EXPECT_EQ(table.lights[0].vertices[1], glm::vec3(7, 6, 7));
    EXPECT_EQ(table.lights[1].vertices[1], glm::vec3(11, 6, 7));
    EXPECT_EQ(table.lights[1].vertices[2], glm::vec3(5, 10, 7));
    // Weights are areas here: 2 and 12.
    EXPECT_FLOAT_EQ(table.total_weight, 14.0f);
    EXPECT_FLOAT_EQ(table.table[0].probability, 2.0f / 14.0f);
    EXPECT_FLOAT_EQ(table.table[1].probability, 12.0f / 14.0f);
    EXPECT_FALSE(table.uses_radius);
}

TEST(LightTable, AMirroredInstanceKeepsItsEmittingSideInFront) {
    HostScene scene;
    const uint32_t mesh = scene.add_mesh(triangle(scene.add_material(emitter({1, 1, 1}))));
    scene.add_instance(mesh, scaled(-1, 1, 1));
    const LightTable table = build_light_table(scene, 0.0);
    // The surface's normal (0, 0, 1) goes through the inverse transpose unchanged: the light is still in front of it.
    EXPECT_GT(front(table.lights[0]).z, 0.0f);
    // Coordinates travel with their vertices.
    for (int i = 0; i < 3; ++i) {
        if (table.lights[0].vertices[i] == glm::vec3(3, 6, 7)) {
            EXPECT_EQ(table.lights[0].uv[i], glm::vec2(1, 0));
        }
    }
}

TEST(LightTable, ADensityPerAreaIsTheSameOnAllTrianglesOfAMaterial) {
    HostScene scene;
    const uint32_t bright = scene.add_material(emitter({10, 20, 30}));
    const uint32_t faint = scene.add_material(emitter({0.1f, 0, 0}));
    const uint32_t a = scene.add_mesh(triangle(bright));
    const uint32_t b = scene.add_mesh(triangle(faint));
    scene.add_instance(a, scaled(1, 1, 1));
    scene.add_instance(a, scaled(0.1f, 3, 1));
    scene.add_instance(b, scaled(5, 5, 5));
    PunctualLight bulb;
    bulb.emission = glm::vec3(2);
    scene.add_punctual_light(bulb);
    const LightTable table = build_light_table(scene, 0.0);
    ASSERT_EQ(table.lights.size(), 4u);
    const uint32_t materials[3] = {bright, bright, faint};
    for (size_t i = 0; i < 3; ++i) {
        const float area = 0.5f * glm::length(front(table.lights[i]));
        const float density = scene.materials()[materials[i]].core.emission_weight / table.total_weight;
        EXPECT_NEAR(table.table[i].probability / area, density, 1e-6f * density) << i;
    }
}

TEST(LightTable, LeavesOutWhatGivesNoLight) {
    HostScene scene;
    const uint32_t glowing = scene.add_material(emitter({1, 1, 1}));
    HostMesh mesh = triangle(glowing);
    mesh.triangles.push_back({0, 0, 1, glowing});  // no area
    scene.add_instance(scene.add_mesh(mesh), scaled(1, 1, 1));
    scene.add_punctual_light(PunctualLight());  // no intensity
    EXPECT_EQ(build_light_table(scene, 0.0).lights.size(), 1u);
    EXPECT_TRUE(build_light_table(HostScene(), 0.0).lights.empty());
}

TEST(LightTable, TexturedEmissionWeighsByTheMeanOfItsTexture) {
    HostScene scene;
    Image image;
    image.width = 2;
    image.height = 1;
    image.bytes = {0xFFFFFFFFu, 0xFF000000u};
    HostMaterial material = emitter({4, 4, 4});
    material.core.emission_texture.texture = scene.add_texture(build_texture(image, TextureRole::color));
    material.core.emission_texture.row_u = {2, 0, 0.5f};
    const uint32_t id = scene.add_material(material);
    scene.add_instance(scene.add_mesh(triangle(id)), scaled(1, 1, 1));
    EXPECT_FLOAT_EQ(scene.materials()[id].core.emission_weight, 2.0f);
    const LightTable table = build_light_table(scene, 0.0);
    EXPECT_FLOAT_EQ(table.total_weight, 4.0f);
    EXPECT_EQ(table.lights[0].emission_texture.texture, 0u);
    EXPECT_EQ(table.lights[0].uv[0], glm::vec2(0.5f, 0));
    EXPECT_EQ(table.lights[0].uv[1], glm::vec2(2.5f, 0));
    EXPECT_EQ(table.lights[0].uv[2], glm::vec2(0.5f, 1));
}

// The power of a spot by numerical integration of the formula in KHR_lights_punctual.
double spot_power_by_quadrature(const CoreLight& light) {
    const int steps = 200000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double cosine = -1.0 + 2.0 * (i + 0.5) / steps;
        const double part = cosine * static_cast<double>(light.spot_scale) + static_cast<double>(light.spot_offset);
        const double attenuation = std::min(std::max(part, 0.0), 1.0);
        sum += attenuation * attenuation * 2.0 / steps;
    }
    return 2.0 * PI * sum;
}

TEST(LightTable, WeightsArePowersOverPi) {
    HostScene scene;
    scene.add_instance(scene.add_mesh(triangle(scene.add_material(HostMaterial()))), scaled(1, 1, 1));
    const double radius = std::sqrt(2.0);  // box 2 x 2 x 0
    PunctualLight light;
    light.emission = glm::vec3(3);
    scene.add_punctual_light(light);
    light.kind = LightKind::spot;
    light.inner_cone = 0.3f;
    light.outer_cone = 0.9f;
    scene.add_punctual_light(light);
    light.kind = LightKind::directional;
    scene.add_punctual_light(light);
    const LightTable table = build_light_table(scene, 7.0);
    ASSERT_EQ(table.lights.size(), 4u);
    EXPECT_TRUE(table.uses_radius);
    const double total = static_cast<double>(table.total_weight);
    const auto weight = [&](size_t i) { return static_cast<double>(table.table[i].probability) * total; };
    EXPECT_NEAR(weight(0), 4.0 * PI * 3.0 / PI, 1e-4);
    EXPECT_NEAR(weight(1), spot_power_by_quadrature(table.lights[1]) * 3.0 / PI, 1e-3);
    EXPECT_NEAR(weight(2), PI * radius * radius * 3.0 / PI, 1e-4);
    EXPECT_NEAR(weight(3), radius * radius * 7.0, 1e-4);
    EXPECT_EQ(table.lights[3].kind, LightKind::sky);
    EXPECT_EQ(table.sky_probability, table.table[3].probability);
}

TEST(LightTable, SpotsFadeFromTheInnerToTheOuterCone) {
    HostScene scene;
    PunctualLight light;
    light.kind = LightKind::spot;
    light.emission = glm::vec3(1);
    light.inner_cone = 0.25f;
    light.outer_cone = 0.75f;
    scene.add_punctual_light(light);
    const CoreLight spot = build_light_table(scene, 0.0).lights.at(0);
    EXPECT_NEAR(std::cos(0.25f) * spot.spot_scale + spot.spot_offset, 1.0f, 1e-5f);
    EXPECT_NEAR(std::cos(0.75f) * spot.spot_scale + spot.spot_offset, 0.0f, 1e-5f);
}

Sky uniform_sky(uint32_t width, uint32_t height, float radiance) {
    Sky sky;
    sky.width = width;
    sky.height = height;
    sky.texels.assign(static_cast<size_t>(width) * height, glm::vec4(radiance));
    return sky;
}

TEST(SkyTable, AUniformSkyIsChosenBySolidAngle) {
    const SkyTable table = build_sky_table(uniform_sky(8, 4, 2.0f));
    EXPECT_NEAR(table.luminance_integral, 4.0 * PI * 2.0, 1e-5);
    ASSERT_EQ(table.table.size(), 32u);
    for (size_t row = 0; row < 4; ++row) {
        const double zone =
            std::cos(PI * static_cast<double>(row) / 4) - std::cos(PI * static_cast<double>(row + 1) / 4);
        for (size_t column = 0; column < 8; ++column) {
            EXPECT_NEAR(static_cast<double>(table.table[row * 8 + column].probability), zone / 2.0 / 8.0, 1e-6);
        }
    }
}

TEST(SkyTable, NoTexelNearLightHasAProbabilityOfZero) {
    Sky sky = uniform_sky(8, 8, 0.0f);
    sky.texels[3 * 8 + 0] = glm::vec4(1.0f);  // at the seam: its neighbours wrap round
    const SkyTable table = build_sky_table(sky);
    for (size_t row = 0; row < 8; ++row) {
        for (size_t column = 0; column < 8; ++column) {
            const bool near = row >= 2 && row <= 4 && (column <= 1 || column == 7);
            EXPECT_EQ(table.table[row * 8 + column].probability > 0.0f, near) << row << ", " << column;
        }
    }
}

TEST(AreaLight, EmitsOnTheSideWhoseCornersRunCounterClockwise) {
    HostScene scene;
    QuadLight quad;
    quad.corners = {glm::vec3(-1, 5, -1), glm::vec3(1, 5, -1), glm::vec3(1, 5, 1), glm::vec3(-1, 5, 1)};
    quad.radiance = {100, 100, 80};
    ASSERT_TRUE(add_area_light(scene, quad).ok());
    const LightTable table = build_light_table(scene, 0.0);
    ASSERT_EQ(table.lights.size(), 2u);
    for (const CoreLight& light : table.lights) {
        EXPECT_LT(front(light).y, 0.0f);
        EXPECT_FALSE(light.two_sided);
        EXPECT_EQ(light.emission, quad.radiance);
    }
    EXPECT_FLOAT_EQ(table.total_weight, 4.0f * luminance(quad.radiance));
    EXPECT_EQ(scene.materials()[0].core.base_color, glm::vec3(0));
    EXPECT_TRUE(scene.has_light());

    quad.corners[3] = quad.corners[1] = quad.corners[0];
    EXPECT_EQ(add_area_light(scene, quad).code, StatusCode::invalid_argument);
}

}  // namespace
}  // namespace render_system::testing::light_table_test
