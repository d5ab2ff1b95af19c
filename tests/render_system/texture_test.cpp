// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/texture.h"

#include <gmock/gmock.h>

#include <cmath>

#include "render_system/core_checks.h"
#include "render_system/texel.h"

namespace render_system::testing::texture_test {
namespace {

using ::testing::ElementsAre;

Image grey_image(uint32_t width, uint32_t height, const std::vector<uint32_t>& levels) {
    Image image;
    image.width = width;
    image.height = height;
    for (uint32_t level : levels) image.bytes.push_back(0xFF000000u | level * 0x010101u);
    return image;
}

uint32_t red(const HostTexture& texture, size_t texel) { return texture.texels[texel] & 0xFFu; }

TEST(Texel, FollowsTheSrgbCurve) {
    // IEC 61966-2-1 at the ends, at the joint of its two branches, and at mid grey.
    EXPECT_EQ(srgb_to_linear(0.0f), 0.0f);
    EXPECT_FLOAT_EQ(srgb_to_linear(1.0f), 1.0f);
    EXPECT_FLOAT_EQ(srgb_to_linear(0.04045f), 0.04045f / 12.92f);
    EXPECT_NEAR(srgb_to_linear(0.5f), 0.21404114f, 1e-7f);
    EXPECT_NEAR(linear_to_srgb(0.21404114f), 0.5f, 1e-7f);
    for (uint32_t byte = 0; byte < 256; ++byte) {
        const uint32_t texel = byte | byte << 8 | byte << 16 | byte << 24;
        for (TexelFormat format : {TexelFormat::rgba8, TexelFormat::rgba8_srgb}) {
            EXPECT_EQ(pack_texel(unpack_texel(texel, format), format), texel);
        }
    }
}

TEST(Texel, PacksSharedExponentsAsVulkanReadsThem) {
    EXPECT_EQ(pack_rgb9e5(glm::vec3(0)), 0u);
    // 1.0 = 256 * 2^(16 - 15 - 9): mantissa 256, exponent 16.
    EXPECT_EQ(pack_rgb9e5(glm::vec3(1)), 16u << 27 | 256u << 18 | 256u << 9 | 256u);
    EXPECT_EQ(unpack_rgb9e5(16u << 27 | 256u << 18 | 128u << 9 | 64u), glm::vec3(0.25f, 0.5f, 1.0f));
    EXPECT_EQ(unpack_rgb9e5(pack_rgb9e5(glm::vec3(65408.0f, 1e9f, 128.0f))), glm::vec3(65408.0f, 65408.0f, 128.0f));
    EXPECT_EQ(pack_rgb9e5(glm::vec3(-1.0f, NAN, -INFINITY)), 0u);
    // Just below 2: rounding carries into the next exponent.
    EXPECT_EQ(unpack_rgb9e5(pack_rgb9e5(glm::vec3(1.9999f))), glm::vec3(2.0f));
    for (float value : {1e-5f, 0.003f, 0.7f, 5.0f, 1234.5f, 60000.0f}) {
        const glm::vec3 color(value, 0.5f * value, 0.25f * value);
        const glm::vec3 back = unpack_rgb9e5(pack_rgb9e5(color));
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(back[i], color[i], value / 511.0f) << value;
    }
}

TEST(Texture, MipLevelsAreMeansOfFour) {
    const HostTexture texture =
        build_texture(grey_image(4, 2, {0, 40, 100, 200, 80, 120, 100, 200}), TextureRole::data);
    ASSERT_EQ(texture.levels, 3u);
    EXPECT_TRUE(validate_texture(texture.view()).ok());
    EXPECT_EQ(red(texture, 8), 60u);
    EXPECT_EQ(red(texture, 9), 150u);
    EXPECT_EQ(red(texture, 10), 105u);
}

TEST(Texture, ColourIsAveragedInLinearLight) {
    // Black and white make linear 0.5, which the curve stores as 188; data would give 128.
    const HostTexture color = build_texture(grey_image(2, 1, {0, 255}), TextureRole::color);
    EXPECT_EQ(color.format, TexelFormat::rgba8_srgb);
    EXPECT_EQ(red(color, 2), 188u);
    const HostTexture data = build_texture(grey_image(2, 1, {0, 255}), TextureRole::data);
    EXPECT_EQ(data.format, TexelFormat::rgba8);
    EXPECT_EQ(red(data, 2), 128u);
}

TEST(Texture, OddSizesShareTexelsByFractions) {
    // 3 -> 1: the mean of three. 5 -> 2: (a + b + c/2) / 2.5 and (c/2 + d + e) / 2.5.
    const HostTexture three = build_texture(grey_image(3, 1, {30, 60, 120}), TextureRole::data);
    ASSERT_EQ(three.texels.size(), 4u);
    EXPECT_EQ(red(three, 3), 70u);
    const HostTexture five = build_texture(grey_image(5, 1, {10, 20, 100, 50, 250}), TextureRole::data);
    ASSERT_EQ(five.texels.size(), 8u);
    EXPECT_EQ(red(five, 5), 32u);
    EXPECT_EQ(red(five, 6), 140u);
    EXPECT_EQ(red(five, 7), 86u);  // the mean of all five
}

TEST(Texture, LevelsAreAveragedBeforeTheyAreRounded) {
    // Four columns of means 0.5, 0.5, 0, 0 levels: rounding at each level would end at 1.
    const HostTexture texture = build_texture(grey_image(8, 1, {0, 1, 0, 1, 0, 0, 0, 0}), TextureRole::data);
    EXPECT_EQ(red(texture, texture.texels.size() - 1), 0u);
}

TEST(Texture, TheSmallestLevelIsTheMeanWhateverTheSize) {
    for (uint32_t width : {1u, 2u, 3u, 7u, 16u, 33u}) {
        for (uint32_t height : {1u, 5u, 8u}) {
            std::vector<uint32_t> levels;
            double sum = 0.0;
            for (uint32_t i = 0; i < width * height; ++i) {
                levels.push_back(i * 37 % 256);
                sum += levels.back();
            }
            const HostTexture texture = build_texture(grey_image(width, height, levels), TextureRole::data);
            EXPECT_TRUE(validate_texture(texture.view()).ok());
            EXPECT_NEAR(red(texture, texture.texels.size() - 1), sum / (width * height), 0.501)
                << width << "x" << height;
        }
    }
}

TEST(Texture, FloatImagesBecomeSharedExponents) {
    Image image;
    image.width = 2;
    image.height = 1;
    image.floats = {{4.0f, 2.0f, 1.0f, 0.5f}, {-1.0f, NAN, 3.0f, 1.0f}};
    image.is_hdr = true;
    const HostTexture texture = build_texture(image, TextureRole::color);
    EXPECT_EQ(texture.format, TexelFormat::rgb9e5);
    ASSERT_EQ(texture.texels.size(), 3u);
    EXPECT_EQ(unpack_texel(texture.texels[0], texture.format), glm::vec4(4, 2, 1, 1));
    EXPECT_EQ(unpack_texel(texture.texels[1], texture.format), glm::vec4(0, 0, 3, 1));
    EXPECT_EQ(unpack_texel(texture.texels[2], texture.format), glm::vec4(2, 1, 2, 1));
}

TEST(Texture, SixteenBitImagesKeepTheirNumbers) {
    Image image;
    image.width = 2;
    image.height = 1;
    image.shorts = {{0x1234, 0xFFFF, 0x0001, 0x8000}, {0x1236, 0xFFFF, 0x0003, 0x8002}};
    const HostTexture data = build_texture(image, TextureRole::data);
    EXPECT_EQ(data.format, TexelFormat::rgba16);
    // The second level is their mean.
    EXPECT_EQ(data.texels,
              (std::vector<uint32_t>{0xFFFF1234u, 0x80000001u, 0xFFFF1236u, 0x80020003u, 0xFFFF1235u, 0x80010002u}));
    EXPECT_NEAR(texel_at(data.texels, 2, data.format).x, 0x1235 / 65535.0, 1e-7);
    const HostTexture color = build_texture(image, TextureRole::color);
    EXPECT_EQ(color.format, TexelFormat::rgba16_srgb);
    EXPECT_EQ(color.texels[0], 0xFFFF1234u) << "already on the curve";
    // IEC 61966-2-1 at 0x1234 / 65535, 0.0711070.
    EXPECT_NEAR(texel_at(color.texels, 0, color.format).x, std::pow((0.0711070 + 0.055) / 1.055, 2.4), 1e-6);
    EXPECT_NEAR(mean_color(color).x, std::pow((0.0711223 + 0.055) / 1.055, 2.4), 1e-6);
}

TEST(Texture, TheMeanColourIsInLinearLight) {
    const HostTexture texture = build_texture(grey_image(2, 1, {0, 255}), TextureRole::color);
    EXPECT_FLOAT_EQ(mean_color(texture).x, 0.5f);
}

}  // namespace
}  // namespace render_system::testing::texture_test
