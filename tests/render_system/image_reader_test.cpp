// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/image_reader.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <cmath>

#include "render_system/loader/load_error.h"
#include "tests/render_system/gltf_file.h"

namespace render_system::testing::image_reader_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::span<const std::byte> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

// Writes `pixels` (0 to 1 or radiance) through OpenImageIO in the format of that ending, and reads the file back.
Image round_trip(const std::string& ending, OIIO::TypeDesc type, int channels, const std::vector<float>& pixels,
                 int width = 2, int height = 1) {
    const TempFolder folder;
    const std::string name = folder / ("image" + ending);
    const auto output = OIIO::ImageOutput::create(name);
    OIIO::ImageSpec spec(width, height, channels, type);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (channels == 2) spec.channelnames = {"Y", "A"};
    if (channels == 2 || channels == 4) spec.alpha_channel = channels - 1;
    EXPECT_TRUE(output->open(name, spec)) << output->geterror();
    EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data())) << output->geterror();
    EXPECT_TRUE(output->close());
    const std::string content = read_file(name);
    return read_image(bytes_of(content), name);
}

const float F = 1.0f / 255.0f;

TEST(ImageReader, ReadsPngsOfOneToFourChannels) {
    EXPECT_THAT(round_trip(".png", OIIO::TypeDesc::UINT8, 1, {10 * F, 20 * F}).bytes,
                ElementsAre(0xFF0A0A0Au, 0xFF141414u));
    EXPECT_THAT(round_trip(".png", OIIO::TypeDesc::UINT8, 2, {10 * F, 20 * F, 30 * F, 0}).bytes,
                ElementsAre(0x140A0A0Au, 0x001E1E1Eu));
    EXPECT_THAT(round_trip(".png", OIIO::TypeDesc::UINT8, 3, {1 * F, 2 * F, 3 * F, 4 * F, 5 * F, 6 * F}).bytes,
                ElementsAre(0xFF030201u, 0xFF060504u));
    // Colour under an alpha of 0 stays: it is not multiplied.
    EXPECT_THAT(round_trip(".png", OIIO::TypeDesc::UINT8, 4, {1, 0, 0, 0, 0, 1, 0, 128 * F}).bytes,
                ElementsAre(0x000000FFu, 0x8000FF00u));
}

TEST(ImageReader, ReadsSixteenBitPngs) {
    const Image image = round_trip(".png", OIIO::TypeDesc::UINT16, 3, {0.25f, 0.5f, 1.0f, 0, 0, 0});
    EXPECT_TRUE(image.bytes.empty());
    EXPECT_FALSE(image.is_hdr);
    EXPECT_NEAR(image.texel(0).x, 0.25f, 1e-5f);
    EXPECT_NEAR(image.texel(0).y, 0.5f, 1e-5f);
    EXPECT_EQ(image.texel(0).z, 1.0f);
    EXPECT_EQ(image.texel(0).w, 1.0f);
}

TEST(ImageReader, ReadsTgaByItsName) {
    EXPECT_THAT(round_trip(".tga", OIIO::TypeDesc::UINT8, 4, {1, 0, 0, 0, 0, 1, 0, 128 * F}).bytes,
                ElementsAre(0x000000FFu, 0x8000FF00u));
    EXPECT_THAT(round_trip(".tga", OIIO::TypeDesc::UINT8, 3, {1 * F, 2 * F, 3 * F, 4 * F, 5 * F, 6 * F}).bytes,
                ElementsAre(0xFF030201u, 0xFF060504u));
}

TEST(ImageReader, ReadsJpegs) {
    const std::vector<float> grey(16 * 16 * 3, 100 * F);
    const Image image = round_trip(".jpg", OIIO::TypeDesc::UINT8, 3, grey, 16, 16);
    ASSERT_EQ(image.bytes.size(), 256u);
    for (uint32_t texel : image.bytes) {
        EXPECT_NEAR(texel & 0xFFu, 100.0, 1.0);
        EXPECT_EQ(texel >> 24, 255u);
    }
}

TEST(ImageReader, ReadsHdrAndExr) {
    for (const char* ending : {".hdr", ".exr"}) {
        const Image image = round_trip(ending, OIIO::TypeDesc::FLOAT, 3, {8.0f, 4.0f, 2.0f, 0.5f, 0.25f, 100.0f});
        EXPECT_TRUE(image.is_hdr) << ending;
        ASSERT_EQ(image.floats.size(), 2u) << ending;
        EXPECT_EQ(image.floats[0], glm::vec4(8, 4, 2, 1)) << ending;
        EXPECT_NEAR(image.floats[1].z, 100.0f, 0.5f) << ending;
    }
}

TEST(ImageReader, PassesOverWhatPngsSayAboutColour) {
    // A gamma chunk (with a wrong checksum, which nobody looks at): the bytes stay what they are.
    std::string image = png(1, 1, 3, {10, 20, 30});
    const std::string gamma("\0\0\0\4gAMA\0\1\x86\xA0\0\0\0\0", 16);
    image.insert(image.find("IDAT") - 4, gamma);
    EXPECT_THAT(read_image(bytes_of(image), "a.png").bytes, ElementsAre(0xFF1E140Au));
}

std::string refusal_of(const std::string& content, const std::string& name) {
    try {
        read_image(bytes_of(content), name);
    } catch (const LoadError& error) {
        return error.message;
    }
    return "nothing wrong";
}

TEST(ImageReader, RefusesWhatItCannotDecode) {
    EXPECT_THAT(refusal_of("", "a.png"), HasSubstr("is empty; copy or save it again"));
    EXPECT_THAT(refusal_of("GIF89a", "a.gif"),
                HasSubstr("is no PNG, JPEG, WebP, BMP, TGA, HDR or EXR image; convert it"));
    EXPECT_THAT(refusal_of("GIF89a", "a.png"), HasSubstr("is no PNG"));
    EXPECT_THAT(refusal_of("\x89PNG and then nothing", "a.png"), HasSubstr("is cut off"));
    const std::string whole = png(8, 8, 3, std::vector<uint8_t>(192, 9));
    EXPECT_THAT(refusal_of(whole.substr(0, 20), "a.png"), HasSubstr("is cut off"));
    EXPECT_THAT(refusal_of(whole.substr(0, whole.size() - 1), "a.png"), HasSubstr("is cut off"));
    std::string damaged = whole;
    damaged[whole.find("IDAT") + 8] ^= 0x55;
    EXPECT_THAT(refusal_of(damaged, "a.png"), AllOf(HasSubstr("cannot be decoded"), HasSubstr("save it again")));
    // OpenImageIO would take memory for what a BMP's header says before anybody could ask.
    std::string bmp = "BM" + std::string(12, '\0') + std::string("\x28\0\0\0\xFF\xFF\xFF\x7F\1\0\0\0", 12);
    EXPECT_THAT(refusal_of(bmp + std::string(100, '\0'), "a.bmp"), HasSubstr("is too large"));
    bmp.replace(18, 8, std::string("\0\x20\0\0\0\xE0\xFF\xFF", 8));  // 8192 by -8192
    EXPECT_THAT(refusal_of(bmp + std::string(100, '\0'), "a.bmp"), HasSubstr("far too short"));
    EXPECT_THAT(refusal_of("BM", "a.bmp"), HasSubstr("is cut off"));
    // A header that promises more pixels than the file can hold.
    std::string huge = whole;
    huge[16] = 0;
    huge[17] = 0;
    huge[18] = 0x3F;  // width 0x3F08
    huge[20] = 0;
    huge[21] = 0;
    huge[22] = 0x3F;
    EXPECT_NE(refusal_of(huge, "a.png"), "nothing wrong");
}

}  // namespace
}  // namespace render_system::testing::image_reader_test
