// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/picture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <ctime>
#include <limits>

namespace picture_test {
namespace {

using namespace application;
using testing::HasSubstr;
using testing::Not;

/// The sRGB level of IEC 61966-2-1 the other way round: the linear value in the middle between two levels.
double linear_of_level(double level) {
    const double encoded = level / 255.0;
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

TEST(SrgbLevel, RoundsToTheNearestLevel) {
    for (int level = 0; level < 255; ++level) {
        const double boundary = linear_of_level(level + 0.5);
        EXPECT_EQ(srgb_level(static_cast<float>(boundary * (1.0 - 1e-6))), level);
        EXPECT_EQ(srgb_level(static_cast<float>(boundary * (1.0 + 1e-6))), level + 1);
    }
}

TEST(SrgbLevel, ClampsWhatIsNoColour) {
    EXPECT_EQ(srgb_level(0.0f), 0);
    EXPECT_EQ(srgb_level(1.0f), 255);
    EXPECT_EQ(srgb_level(-1.0f), 0);
    EXPECT_EQ(srgb_level(1e30f), 255);
    EXPECT_EQ(srgb_level(std::numeric_limits<float>::infinity()), 255);
    EXPECT_EQ(srgb_level(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(DifferenceImage, IsTheAbsoluteDifferenceTimesGain) {
    const Channels<uint8_t> a{1, 1, {10, 20, 0}}, b{1, 1, {12, 19, 255}};
    EXPECT_THAT(difference_image(a, b, 16).rgb, testing::ElementsAre(32, 16, 255));
}

TEST(ImageKind, GoesByTheEndOfTheName) {
    EXPECT_EQ(*image_kind("a.png"), ImageKind::png);
    EXPECT_EQ(*image_kind("dir.x/A.EXR"), ImageKind::exr);
    for (const char* name : {"a.jpg", "a", "png", "dir.png/a", ""}) {
        const auto kind = image_kind(name);
        ASSERT_FALSE(kind.ok()) << name;
        EXPECT_THAT(kind.status.message, HasSubstr(".png nor .exr"));
    }
}

Picture gradient() {
    Picture picture(5, 3);
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
        const auto x = static_cast<float>(i);
        picture.pixels[i] = {0.07f * x, 1.5f - 0.1f * x, -0.01f * x, 1.0f};
    }
    return picture;
}

/// Reads an encoded file back through OpenImageIO, as values of type T.
template <class T>
std::vector<T> decode(const std::string& bytes, const std::string& name, OIIO::TypeDesc type, OIIO::ImageSpec& spec) {
    OIIO::Filesystem::IOMemReader reader(const_cast<char*>(bytes.data()), bytes.size());
    auto input = OIIO::ImageInput::open(name, nullptr, &reader);
    if (!input) return {};
    spec = input->spec();
    std::vector<T> values(static_cast<size_t>(spec.width * spec.height * spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, type, values.data())) return {};
    return values;
}

TEST(EncodePng, KeepsTheLevels) {
    const auto levels = srgb_levels(gradient());
    const auto bytes = encode_png(levels);
    ASSERT_TRUE(bytes.ok());
    OIIO::ImageSpec spec;
    EXPECT_EQ(decode<uint8_t>(*bytes, "a.png", OIIO::TypeDesc::UINT8, spec), levels.rgb);
    EXPECT_EQ(spec.width, 5);
    EXPECT_EQ(spec.height, 3);
    EXPECT_EQ(spec.nchannels, 3);
}

TEST(EncodeExr, KeepsEveryBitOfTheRadiance) {
    const auto values = linear_values(gradient());
    const auto bytes = encode_exr(values);
    ASSERT_TRUE(bytes.ok());
    OIIO::ImageSpec spec;
    const auto back = decode<float>(*bytes, "a.exr", OIIO::TypeDesc::FLOAT, spec);
    ASSERT_EQ(back.size(), values.rgb.size());
    EXPECT_EQ(std::memcmp(back.data(), values.rgb.data(), back.size() * sizeof(float)), 0);
    EXPECT_EQ(spec.format, OIIO::TypeDesc::FLOAT);
}

TEST(Encoding, TellsNeitherDateNorProgram) {
    const std::time_t now = std::time(nullptr);
    char this_month[] = "YYYY:MM";  // as both formats write it
    std::strftime(this_month, sizeof this_month, "%Y:%m", std::localtime(&now));
    for (const ImageKind kind : {ImageKind::png, ImageKind::exr}) {
        const auto bytes = encode_picture(gradient(), kind, 0.0f, ToneMap::none);
        ASSERT_TRUE(bytes.ok());
        for (const char* word : {"tIME", "DateTime", "Software", "software", "OpenImageIO", "HostComputer"}) {
            EXPECT_THAT(*bytes, Not(HasSubstr(word)));
        }
        EXPECT_THAT(*bytes, Not(HasSubstr(this_month)));
    }
}

}  // namespace
}  // namespace picture_test
