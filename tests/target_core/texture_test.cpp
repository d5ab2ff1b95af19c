// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/kernels/texture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "target_core/core_tables.h"

using namespace target_core;
using namespace target_core::kernels;
using render_system::CoreTexture;
using render_system::TexelFormat;
using render_system::TextureWrap;

namespace {

class Texture : public testing::Test {
protected:
    void bind(CoreTexture texture, std::vector<uint32_t> texels) {
        texels_ = std::move(texels);
        texture.texels = texels_;
        pack_textures(std::span(&texture, 1), tables_);
        bound.textures = tables_.textures.data();
        bound.texels = tables_.texels.data();
    }
    void TearDown() override { bound = {}; }

    SceneTables tables_;
    std::vector<uint32_t> texels_;
};

CoreTexture two_by_two(TextureWrap wrap) {
    CoreTexture texture;
    texture.width = 2;
    texture.height = 2;
    texture.wrap_s = wrap;
    texture.wrap_t = wrap;
    return texture;
}

const std::vector<uint32_t> CORNERS = {0xFF000000u, 0xFF0000FFu, 0xFF00FF00u, 0xFFFF0000u};

TEST_F(Texture, BilinearMeetsTexelCentresAndTheirMean) {
    bind(two_by_two(TextureWrap::clamp_to_edge), CORNERS);
    vec4 red = sample_texture(0, vec2(0.75f, 0.25f), 0.0f);
    EXPECT_FLOAT_EQ(red.x, 1.0f);
    EXPECT_FLOAT_EQ(red.y, 0.0f);
    vec4 middle = sample_texture(0, vec2(0.5f, 0.5f), 0.0f);
    EXPECT_FLOAT_EQ(middle.x, 0.25f);
    EXPECT_FLOAT_EQ(middle.y, 0.25f);
    EXPECT_FLOAT_EQ(middle.z, 0.25f);
}

TEST_F(Texture, WrapModesFollowGltf) {
    bind(two_by_two(TextureWrap::repeat), CORNERS);
    EXPECT_FLOAT_EQ(sample_texture(0, vec2(-1.25f, 3.25f), 0.0f).x, 1.0f) << "-1.25 repeats to 0.75";
    bind(two_by_two(TextureWrap::mirrored_repeat), CORNERS);
    EXPECT_FLOAT_EQ(sample_texture(0, vec2(1.25f, 0.25f), 0.0f).x, 1.0f) << "1.25 mirrors to 0.75";
    EXPECT_FLOAT_EQ(sample_texture(0, vec2(-0.75f, 0.25f), 0.0f).x, 1.0f) << "-0.75 mirrors to 0.75";
    bind(two_by_two(TextureWrap::clamp_to_edge), CORNERS);
    EXPECT_FLOAT_EQ(sample_texture(0, vec2(7.0f, -2.0f), 0.0f).x, 1.0f);
}

TEST_F(Texture, NearestDoesNotMix) {
    CoreTexture texture = two_by_two(TextureWrap::repeat);
    texture.nearest = true;
    bind(texture, CORNERS);
    EXPECT_FLOAT_EQ(sample_texture(0, vec2(0.51f, 0.01f), 0.0f).x, 1.0f);
    EXPECT_FLOAT_EQ(sample_texture(0, vec2(0.49f, 0.49f), 0.0f).x, 0.0f);
}

TEST_F(Texture, LevelsBlendByFootprint) {
    CoreTexture texture = two_by_two(TextureWrap::repeat);
    texture.levels = 2;
    std::vector<uint32_t> texels(4, 0xFF0000FFu);
    texels.push_back(0xFF00FF00u);
    bind(texture, texels);
    EXPECT_FLOAT_EQ(sample_texture(0, vec2(0.3f, 0.3f), 0.25f).x, 1.0f) << "one texel: level 0";
    EXPECT_FLOAT_EQ(sample_texture(0, vec2(0.3f, 0.3f), 1.0f).y, 1.0f) << "four texels: level 1";
    EXPECT_NEAR(sample_texture(0, vec2(0.3f, 0.3f), 0.5f).y, 0.5f, 1e-6f) << "two texels: half way";
    EXPECT_FLOAT_EQ(sample_texture(0, vec2(0.3f, 0.3f), 1e20f).y, 1.0f) << "never past the last level";
}

TEST_F(Texture, SharedExponentDecodesAsVulkanDefinesIt) {
    // E5B9G9R9: value = mantissa * 2^(exponent - 15 - 9).
    CoreTexture texture;
    texture.width = 1;
    texture.height = 1;
    texture.format = TexelFormat::rgb9e5;
    bind(texture, {511u | 256u << 9 | 1u << 18 | 24u << 27});
    vec4 c = sample_texture(0, vec2(0.5f, 0.5f), 0.0f);
    EXPECT_FLOAT_EQ(c.x, 511.0f);
    EXPECT_FLOAT_EQ(c.y, 256.0f);
    EXPECT_FLOAT_EQ(c.z, 1.0f);
    EXPECT_FLOAT_EQ(c.w, 1.0f);
}

}  // namespace
