// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/option_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace option_values_test {
namespace {

using namespace application;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(OptionValues, ASizeIsTwoWholeNumbers) {
    const auto size = parse_size("1920x1080");
    ASSERT_TRUE(size.ok());
    EXPECT_EQ(size->width, 1920u);
    EXPECT_EQ(size->height, 1080u);
    EXPECT_TRUE(parse_size("1x1").ok());
    EXPECT_TRUE(parse_size("32768x4096").ok());
}

TEST(OptionValues, WhatIsNoSizeIsRefusedWithARemedy) {
    for (const char* text : {"0x0", "0x9", "640", "640x", "x360", "640x360x3", "-1x5", "+1x5", " 1x5", "1.5x2", "axb",
                             "", "32769x1", "32768x32768", "99999999999999999999x1", "640X360"}) {
        const auto size = parse_size(text);
        ASSERT_FALSE(size.ok()) << text;
        EXPECT_THAT(size.status.message, HasSubstr(std::string("'") + text + "'"));
        EXPECT_THAT(size.status.message, HasSubstr("e.g. 640x360"));
    }
}

TEST(OptionValues, NumbersKeepToTheirRange) {
    EXPECT_EQ(*parse_number("0", 0, 5), 0u);
    EXPECT_EQ(*parse_number("4294967295", 0, UINT32_MAX), UINT32_MAX);
    for (const char* text : {"0", "6", "", "-1", "1e1", "0x1", "3 ", "three", "4294967296", "nan"}) {
        EXPECT_FALSE(parse_number(text, 1, 5).ok()) << text;
    }
    EXPECT_THAT(parse_number("6", 1, 5).status.message, HasSubstr("'6' is not a whole number from 1 to 5"));
}

TEST(OptionValues, SampleCountsAreAList) {
    EXPECT_THAT(*parse_sample_counts("1,4,16"), ElementsAre(1u, 4u, 16u));
    EXPECT_THAT(*parse_sample_counts("8"), ElementsAre(8u));
    for (const char* text : {"", ",", "1,", "0", "1,0", "1;2", "1, 4"}) {
        EXPECT_FALSE(parse_sample_counts(text).ok()) << text;
    }
}

TEST(OptionValues, AnSsimLiesBetweenMinusOneAndOne) {
    EXPECT_EQ(*parse_ssim("0.9999"), 0.9999);
    EXPECT_EQ(*parse_ssim("-1"), -1.0);
    for (const char* text : {"1.01", "-1.01", "nan", "inf", "", "x"}) EXPECT_FALSE(parse_ssim(text).ok()) << text;
}

TEST(OptionValues, MebibytesBecomeBytes) {
    EXPECT_EQ(*parse_mebibytes("64"), 67108864u);
    EXPECT_FALSE(parse_mebibytes("0").ok());
    EXPECT_FALSE(parse_mebibytes("64M").ok());
}

TEST(OptionValues, ACameraIsAnIndexOrAFile) {
    EXPECT_EQ(parse_camera("3")->index, 3u);
    EXPECT_EQ(parse_camera("camera.json")->file, "camera.json");
    EXPECT_EQ(parse_camera("3")->file, "");
    EXPECT_FALSE(parse_camera("camera.json")->index.has_value());
    EXPECT_FALSE(parse_camera("").ok());
    EXPECT_FALSE(parse_camera("99999999999").ok());
    EXPECT_THAT(parse_camera("-1").status.message, HasSubstr("counted from 0"));
    EXPECT_EQ(parse_camera("./-1")->file, "./-1");
    EXPECT_EQ(parse_camera("-1.json")->file, "-1.json");
}

TEST(OptionValues, ASkyIsARadianceOrAFile) {
    EXPECT_THAT(*parse_sky("1,0.5,0")->radiance, ElementsAre(1.0f, 0.5f, 0.0f));
    EXPECT_EQ(parse_sky("sunset.hdr")->file, "sunset.hdr");
    EXPECT_EQ(parse_sky("../a.b/sunset.exr")->file, "../a.b/sunset.exr");
    for (const char* text : {"", "1", "0.5", "1,2", "1,2,3,4", "-1,0,0", "nan,0,0", "1,2,inf", "a,b,c", "sunset"}) {
        const auto sky = parse_sky(text);
        ASSERT_FALSE(sky.ok()) << text;
        EXPECT_THAT(sky.status.message, HasSubstr("R,G,B"));
    }
}

TEST(OptionValues, AViewIsTwoDifferentPoints) {
    const auto view = parse_look_at("1,2.5,-3,0,0,1e-3");
    ASSERT_TRUE(view.ok());
    EXPECT_THAT(view->eye, ElementsAre(1.0f, 2.5f, -3.0f));
    EXPECT_THAT(view->target, ElementsAre(0.0f, 0.0f, 1e-3f));
    for (const char* text :
         {"", "1,2,3", "1,2,3,4,5", "1,2,3,4,5,6,7", "1,2,3,1,2,3", "1,2,3,4,5,nan", "1,2,3,4,5,x"}) {
        EXPECT_THAT(parse_look_at(text).status.message, HasSubstr("e.g. 0,1,5,0,1,0")) << text;
    }
}

TEST(OptionValues, AnglesAndStopsKeepToTheirRange) {
    EXPECT_NEAR(*parse_fov("90"), 1.5707963f, 1e-6f);
    EXPECT_EQ(*parse_exposure("-1.5"), -1.5f);
    for (const char* text : {"0", "-1", "180", "nan", "inf", "", "40deg"}) EXPECT_FALSE(parse_fov(text).ok()) << text;
    EXPECT_EQ(*parse_limit("0.5"), 0.5f);
    for (const char* text : {"0", "-1", "nan", "inf", "", "x"}) EXPECT_FALSE(parse_limit(text).ok()) << text;
    EXPECT_EQ(*parse_length("0.25"), 0.25f);
    for (const char* text : {"0", "-1", "nan", "inf", "", "x"}) EXPECT_FALSE(parse_length(text).ok()) << text;
    for (const char* text : {"101", "nan", "-inf", "", "+1"}) EXPECT_FALSE(parse_exposure(text).ok()) << text;
}

TEST(OptionValues, CoresAreAListOfTheirNames) {
    EXPECT_THAT(*parse_cores("auto"), ElementsAre("auto"));
    EXPECT_THAT(*parse_cores("source,target,null"), ElementsAre("source", "target", "null"));
    for (const char* text : {"", "source,", "auto,source", "gpu", "target,target"})
        EXPECT_FALSE(parse_cores(text).ok()) << text;
}

}  // namespace
}  // namespace option_values_test
