// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/default_sky.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render_system/texel.h"

namespace render_system::testing::default_sky_test {
namespace {

// A floor of 2 by 2 around the origin, y up, and a camera that sees nothing else.
class DefaultSky : public ::testing::Test {
protected:
    DefaultSky() {
        floor_ = material(0.0f);
        quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, floor_);
        camera_ = look_at({0, 3, 0.01f}, {0, 0, 0}, {0, 0, -1}, 0.5f);
    }

    uint32_t material(float radiance, bool double_sided = false) {
        HostMaterial result;
        result.core.emission = glm::vec3(radiance);
        result.core.double_sided = double_sided;
        return scene_.add_material(result);
    }

    // In front where edge_u x edge_v points.
    void quad(const glm::vec3& corner, const glm::vec3& edge_u, const glm::vec3& edge_v, uint32_t material) {
        HostMesh mesh;
        mesh.positions = {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
        mesh.normals.assign(4, glm::normalize(glm::cross(edge_u, edge_v)));
        mesh.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        mesh.triangles = {{0, 1, 2, material}, {0, 2, 3, material}};
        // Its own space is not the world's, so that the way there is taken too.
        for (glm::vec3& p : mesh.positions) p = 0.5f * (p - glm::vec3(1, 2, 3));
        CoreTransform transform;
        for (int i = 0; i < 3; ++i) transform.rows[i] = glm::vec4(0, 0, 0, static_cast<float>(i + 1));
        for (int i = 0; i < 3; ++i) transform.rows[i][i] = 2.0f;
        scene_.add_instance(scene_.add_mesh(mesh), transform);
    }

    // A panel of that area above the floor, `height` up, that shines downwards.
    void panel(float area, float height, uint32_t material) {
        const float side = std::sqrt(area);
        quad({-0.5f * side, height, -0.5f * side}, {side, 0, 0}, {0, 0, side}, material);
    }

    bool lit() const { return lights_itself(scene_, camera_); }

    HostScene scene_;
    Camera camera_;
    uint32_t floor_ = 0;
};

TEST_F(DefaultSky, NoLightIsNoLight) { EXPECT_FALSE(lit()); }

TEST_F(DefaultSky, AnyPunctualLightWill) {
    scene_.add_punctual_light({});
    EXPECT_TRUE(lit());
}

// Radiance times area over the squared distance, cosines of nearly 1: from 20 up on 2 by 2, within 1 %.
TEST_F(DefaultSky, TheIrradianceOfAPanelDecides) {
    for (const float irradiance : {0.045f, 0.055f}) {
        HostScene empty = scene_;
        panel(1.0f, 20.0f, material(irradiance * 400.0f));
        EXPECT_EQ(lit(), irradiance > 0.05f) << irradiance;
        scene_ = empty;
    }
}

TEST_F(DefaultSky, ManySmallLightsAddUp) {
    const uint32_t faint = material(0.055f * 400.0f);
    for (int i = 0; i < 100; ++i) {
        const float x = 0.1f * static_cast<float>(i % 10), z = 0.1f * static_cast<float>(i / 10);
        quad({x - 0.5f, 20, z - 0.5f}, {0.1f, 0, 0}, {0, 0, 0.1f}, faint);
    }
    EXPECT_TRUE(lit());
}

TEST_F(DefaultSky, WhatStandsInTheWayIsSeen) {
    panel(1.0f, 20.0f, material(100.0f));
    EXPECT_TRUE(lit());
    quad({-1, 10, -1}, {2, 0, 0}, {0, 0, 2}, floor_);
    EXPECT_FALSE(lit());
}

// The strip of the panel that a point sees through a slit w wide, half way up: about 2 w of 2 across, above it. The
// irradiance is at least 20 w for w = 0.04, and below 0.05 for w = 0.0004.
TEST_F(DefaultSky, ASlitLetsEnoughOfABrightLightThrough) {
    camera_ = look_at({0, 0.5f, 0.01f}, {0, 0, 0}, {0, 0, -1}, 0.3f);
    for (const float half : {0.02f, 0.0002f}) {
        HostScene empty = scene_;
        panel(16.0f, 2.0f, material(20.0f));
        quad({-9, 1, -9}, {9 - half, 0, 0}, {0, 0, 18}, floor_);
        quad({half, 1, -9}, {9 - half, 0, 0}, {0, 0, 18}, floor_);
        EXPECT_EQ(lit(), half == 0.02f);
        scene_ = empty;
    }
}

// A wall beside the light shades the floor up to x: the share that is lit decides.
TEST_F(DefaultSky, AtLeastHalfOfThePointsCount) {
    for (const float edge : {-0.1f, 0.1f}) {
        HostScene empty = scene_;
        panel(0.0001f, 2000.0f, material(1e10f));
        quad({edge, 1000, -9}, {9, 0, 0}, {0, 0, 18}, floor_);  // shade from 2 * edge on
        EXPECT_EQ(lit(), edge > 0.0f);
        scene_ = empty;
    }
}

TEST_F(DefaultSky, OneSidedEmittersShineToTheFrontAlone) {
    for (const bool double_sided : {false, true}) {
        HostScene empty = scene_;
        quad({-1, 5, -1}, {0, 0, 2}, {2, 0, 0}, material(100.0f, double_sided));
        EXPECT_EQ(lit(), double_sided);
        scene_ = empty;
    }
}

// A sign with one bright texel of 64 on a flat thing: what does not shine gets nothing from it.
TEST_F(DefaultSky, OneEmissiveTexelDoesNotLightItsOwnSurface) {
    HostTexture texture;
    texture.width = texture.height = 8;
    texture.texels.assign(64, pack_texel(glm::vec4(0, 0, 0, 1), texture.format));
    texture.texels[27] = pack_texel(glm::vec4(1.0f), texture.format);
    HostMaterial material;
    material.core.emission = glm::vec3(1.0f);
    material.core.emission_texture.texture = scene_.add_texture(texture);
    quad({-1, 0.5f, 1}, {2, 0, 0}, {0, 0, -2}, scene_.add_material(material));
    EXPECT_FALSE(lit());
}

TEST_F(DefaultSky, WhereOnlyEmittersAreSeenNoneIsNeeded) {
    quad({-1, 0.5f, 1}, {2, 0, 0}, {0, 0, -2}, material(1.0f));
    EXPECT_TRUE(lit());
    camera_ = look_at({0, 3, 0}, {0, 9, 0}, {0, 0, -1}, 0.5f);
    EXPECT_FALSE(lit()) << "nothing is seen";
}

// A coloured backdrop beside lit things would leave them in its colour alone.
TEST_F(DefaultSky, WhatUnlitSurfacesGiveOffIsNoLight) {
    HostMaterial shown;
    shown.core.emission = glm::vec3(1.0f);
    shown.unlit = true;
    panel(4.0f, 2.0f, scene_.add_material(shown));
    EXPECT_TRUE(lit()) << "from above, only what is unlit is seen";
    camera_ = look_at({0, 1.0f, 0.01f}, {0, 0, 0}, {0, 0, -1}, 0.5f);
    EXPECT_FALSE(lit()) << "the floor below has the panel's colour alone";
    panel(4.0f, 1.5f, material(1.0f));
    EXPECT_TRUE(lit()) << "a light beside it";
}

TEST(StudioSky, IsNeutralAndGivesAWhiteFloorARadianceOfOne) {
    const Sky sky = studio_sky();
    ASSERT_EQ(sky.texels.size(), size_t{sky.width} * sky.height);
    double irradiance = 0.0;
    const double step = 3.14159265358979 / sky.height;
    for (uint32_t y = 0; y < sky.height; ++y) {
        const double polar = step * (y + 0.5);
        for (uint32_t x = 0; x < sky.width; ++x) {
            const glm::vec4& texel = sky.texels[size_t{y} * sky.width + x];
            ASSERT_TRUE(texel.x == texel.y && texel.y == texel.z && texel.x > 0.0f);
            irradiance += static_cast<double>(texel.x) * std::max(std::cos(polar), 0.0) * std::sin(polar) * step *
                          (2.0 * 3.14159265358979 / sky.width);
        }
    }
    EXPECT_NEAR(irradiance / 3.14159265358979, 1.0, 0.05);
}

}  // namespace
}  // namespace render_system::testing::default_sky_test
