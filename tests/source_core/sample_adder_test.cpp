// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/sample_adder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace source_core {
namespace {

using render_system::PixelSum;

constexpr uint32_t kPictures = 5;

glm::vec4 radiance(uint32_t picture, size_t pixel) {
    const auto value = static_cast<float>(pixel % 1000) * 0.1f;
    return {value, 3.0f - static_cast<float>(picture), value * static_cast<float>(picture) + 1e-7f, 1.0f};
}

/// The sums of the pictures one by one are the oracle: more pixels than one thread takes, and fewer; with squares, and
/// without.
void expect_sums(size_t pixels, uint32_t threads, bool with_squares) {
    std::vector<PixelSum> sums(pixels), expected(pixels);
    std::vector<double> squares(with_squares ? pixels : 0), expected_squares(squares.size());
    std::vector<glm::vec4> first(pixels);
    {
        SampleAdder adder(sums, squares, first, threads);
        for (uint32_t picture = 0; picture < kPictures; ++picture) {
            const std::span<glm::vec4> room = adder.room();
            ASSERT_EQ(room.size(), pixels);
            for (size_t i = 0; i < pixels; ++i) room[i] = radiance(picture, i);
            adder.add();
        }
    }
    for (uint32_t picture = 0; picture < kPictures; ++picture) {
        for (size_t i = 0; i < pixels; ++i) {
            const glm::vec4 value = radiance(picture, i);
            add_sample(expected[i], value);
            const double luminance = 0.2126 * value.x + 0.7152 * value.y + 0.0722 * value.z;
            if (with_squares) expected_squares[i] += luminance * luminance;
        }
    }
    EXPECT_TRUE(std::ranges::equal(sums, expected)) << pixels << " pixels, " << threads << " threads";
    EXPECT_EQ(squares, expected_squares);
}

TEST(SampleAdder, AddsEveryPictureOnceWhileTheNextIsWritten) {
    for (const size_t pixels : {1u, 16384u, 16385u, 100003u}) {
        for (const uint32_t threads : {1u, 2u, 5u}) {
            expect_sums(pixels, threads, true);
            expect_sums(pixels, threads, false);
        }
    }
}

}  // namespace
}  // namespace source_core
