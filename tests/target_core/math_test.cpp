// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/kernels/math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "target_core/kernels/texture.h"

using namespace target_core::kernels;

namespace {

TEST(Math, CosineAndSineOfATurnAgreeWithLibm) {
    for (int i = 0; i < 100000; ++i) {
        float turns = static_cast<float>(i) / 100000.0f;
        vec2 found = cos_sin_turns(turns);
        double angle = 2.0 * std::numbers::pi * static_cast<double>(turns);
        ASSERT_NEAR(found.x, std::cos(angle), 4e-7) << turns;
        ASSERT_NEAR(found.y, std::sin(angle), 4e-7) << turns;
    }
}

TEST(Math, ArcCosineAgreesWithLibm) {
    for (int i = -100000; i <= 100000; ++i) {
        float x = static_cast<float>(i) / 100000.0f;
        ASSERT_NEAR(arc_cosine(x), std::acos(static_cast<double>(x)), 1e-6) << x;
    }
}

TEST(Math, ArcTangentAgreesWithLibmInAllQuadrants) {
    for (int i = 0; i < 100000; ++i) {
        double angle = -3.14159 + 6.28318 * i / 100000.0;
        float x = static_cast<float>(3.0 * std::cos(angle));
        float y = static_cast<float>(3.0 * std::sin(angle));
        ASSERT_NEAR(arc_tangent(y, x), std::atan2(static_cast<double>(y), static_cast<double>(x)), 1e-6) << angle;
    }
    EXPECT_EQ(arc_tangent(0.0f, 0.0f), 0.0f);
}

TEST(Math, BinaryLogarithmAgreesWithLibmOverTheWholeRange) {
    for (float x = 1.2e-38f; x < 3.0e38f; x *= 1.0037f) {
        double truth = std::log2(static_cast<double>(x));
        ASSERT_NEAR(log_2(x), truth, 2e-7 * std::max(1.0, std::fabs(truth))) << x;
    }
    EXPECT_EQ(log_2(1.0f), 0.0f);
    EXPECT_EQ(log_2(1024.0f), 10.0f);
}

TEST(Math, SrgbCurveAgreesWithTheStandardForEveryByte) {
    for (unsigned byte = 0; byte < 256; ++byte) {
        double c = byte / 255.0;
        double truth = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        ASSERT_NEAR(linear_from_srgb(unorm8(byte)), truth, 3e-6) << byte;
    }
    EXPECT_EQ(unorm8(255), 1.0f);
}

TEST(Math, FramesAreOrthonormalForAnyNormal) {
    for (int i = 0; i < 10000; ++i) {
        double z = -1.0 + 2.0 * i / 9999.0;
        double phi = i * 2.399963;
        double r = std::sqrt(std::max(0.0, 1.0 - z * z));
        vec3 n(static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(z));
        Frame frame = frame_around(n);
        ASSERT_NEAR(dot(frame.tangent, frame.tangent), 1.0f, 1e-5f);
        ASSERT_NEAR(dot(frame.bitangent, frame.bitangent), 1.0f, 1e-5f);
        ASSERT_NEAR(dot(frame.tangent, frame.bitangent), 0.0f, 1e-5f);
        ASSERT_NEAR(dot(frame.tangent, n), 0.0f, 1e-5f);
        ASSERT_NEAR(dot(cross(frame.tangent, frame.bitangent), n), 1.0f, 1e-5f);
    }
}

TEST(Math, NormalizedKeepsTheZeroVectorFinite) {
    vec3 zero = normalized(vec3(0.0f));
    EXPECT_EQ(zero.x, 0.0f);
    EXPECT_EQ(zero.y, 0.0f);
    EXPECT_EQ(zero.z, 0.0f);
}

}  // namespace
