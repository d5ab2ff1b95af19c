// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "application/picture.h"

namespace tone_map_test {
namespace {

using namespace application;

constexpr ToneMap kCurves[] = {ToneMap::none, ToneMap::neutral, ToneMap::aces, ToneMap::agx};

TEST(ToneMap, NoneKeepsEveryBit) {
    for (const float value : {0.0f, 1e-30f, 0.18f, 1.0f, 7.3f, 1e30f})
        EXPECT_EQ(tone_mapped(glm::vec3(value), 1.0f, ToneMap::none), glm::vec3(value));
}

TEST(ToneMap, AStopIsAFactorOfTwo) {
    const glm::vec3 color(0.1f, 0.2f, 0.05f);
    for (const ToneMap curve : kCurves)
        EXPECT_EQ(tone_mapped(color, 2.0f, curve), tone_mapped(2.0f * color, 1.0f, curve));
    Picture picture(1, 1);
    picture.pixels[0] = glm::vec4(0.25f, 0.5f, 0.125f, 1.0f);
    EXPECT_EQ(srgb_levels(picture, 1.0f, ToneMap::none).rgb,
              (std::vector<uint8_t>{srgb_level(0.5f), 255, srgb_level(0.25f)}));
}

TEST(ToneMap, CurvesRiseStayInRangeAndKeepGreyGrey) {
    for (const ToneMap curve : kCurves) {
        if (curve == ToneMap::none) continue;
        float before = -1.0f;
        for (float stops = -12.0f; stops < 40.0f; stops += 0.25f) {
            const glm::vec3 grey = tone_mapped(glm::vec3(std::exp2(stops)), 1.0f, curve);
            EXPECT_NEAR(grey.x, grey.y, 4e-3f) << stops;
            EXPECT_NEAR(grey.y, grey.z, 4e-3f) << stops;
            EXPECT_GE(grey.x, before - 1e-6f) << stops;
            EXPECT_TRUE(grey.x >= 0.0f && grey.x <= 1.0f) << stops;
            before = grey.x;
        }
        EXPECT_GT(before, 0.9f);
        EXPECT_EQ(tone_mapped(glm::vec3(std::numeric_limits<float>::quiet_NaN(), -1, 0), 1.0f, curve),
                  tone_mapped(glm::vec3(0.0f), 1.0f, curve));
    }
}

// The specification's own figures: grey x below 0.8 comes out as x - 0.04 from 0.08 on and as 6.25 x^2 below; pure
// colours stay as they are; what is far brighter fades to white.
TEST(ToneMap, NeutralIsThatOfItsSpecification) {
    const auto grey = [](float x) { return tone_mapped(glm::vec3(x), 1.0f, ToneMap::neutral).x; };
    EXPECT_NEAR(grey(0.5f), 0.46f, 1e-6f);
    EXPECT_NEAR(grey(0.04f), 6.25f * 0.04f * 0.04f, 1e-7f);
    EXPECT_EQ(tone_mapped({0.5f, 0, 0.25f}, 1.0f, ToneMap::neutral), glm::vec3(0.5f, 0, 0.25f));
    // peak 1.96 after the offset: 1 - 0.24^2 / (1.96 + 0.24 - 0.76).
    EXPECT_NEAR(grey(2.0f), 1.0f - 0.0576f / 1.44f, 1e-6f);
    const glm::vec3 red = tone_mapped({1000, 0, 0}, 1.0f, ToneMap::neutral);
    EXPECT_GT(red.x, 0.99f);
    EXPECT_GT(red.y, 0.98f);
}

// Mid grey, as the fits' authors show it.
TEST(ToneMap, MidGreyLandsWhereTheFitsPutIt) {
    EXPECT_NEAR(tone_mapped(glm::vec3(0.18f), 1.0f, ToneMap::aces).x, 0.1055f, 5e-3f);
    EXPECT_NEAR(tone_mapped(glm::vec3(0.18f), 1.0f, ToneMap::agx).x, 0.18f, 0.04f);
}

}  // namespace
}  // namespace tone_map_test
