// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "application/core_session.h"
#include "application/option_values.h"
#include "application/sampling/sample_sums.h"
#include "application/scene_setup.h"

namespace sampling_test {
namespace {

using namespace application;
using render_system::PixelSum;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(PixelSums, AreExactInEveryOrder) {
    // Of values with no common scale a double's sum depends on the order; this one does not.
    const float values[] = {1e9f, 3e-9f, -1e9f, 0.1f, 7.25e5f, 1e-14f, -3.3e-7f, 123.456f, 1.1e12f, 0.0f, -2.5f};
    PixelSum forwards, backwards, halves[2];
    for (size_t i = 0; i < std::size(values); ++i) {
        add_sample(forwards, glm::vec3(values[i]));
        add_sample(backwards, glm::vec3(values[std::size(values) - 1 - i]));
        add_sample(halves[i % 2], glm::vec3(values[i]));
    }
    add_sum(halves[1], halves[0]);
    EXPECT_EQ(forwards, backwards);
    EXPECT_EQ(forwards, halves[1]);
    // 1.1e12 as a float is 1099999969280; the rest by hand.
    long double sum = 0.0L;
    for (const float value : values) sum += static_cast<long double>(value);
    EXPECT_EQ(mean_of(forwards, 1).x, static_cast<float>(sum));
    PixelSum one;
    add_sample(one, {0.1f, 1e-12f, 65504.0f});
    EXPECT_EQ(mean_of(one, 1).x, 0.1f);
    EXPECT_NEAR(mean_of(one, 1).y, 1e-12f, 5e-16f) << "half of a unit in the last place of the sum";
    EXPECT_EQ(mean_of(one, 1).z, 65504.0f);
}

TEST(PixelSums, StayNotFinite) {
    PixelSum sum;
    add_sample(sum, {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), 1.0f});
    add_sample(sum, glm::vec3(1.0f));
    EXPECT_TRUE(std::isinf(mean_of(sum, 2).x));
    EXPECT_TRUE(std::isnan(mean_of(sum, 2).y));
    EXPECT_EQ(mean_of(sum, 2).z, 1.0f);
}

TEST(SampleRanges, AreReadAsTheyAreWritten) {
    EXPECT_EQ(range_text({{0, 8}, {12, 16}}), "0:8,12:16");
    EXPECT_THAT(ranges_of_text("0:8,12:16"), ElementsAre(SampleRange{0, 8}, SampleRange{12, 16}));
    for (const char* text :
         {"", "8", "8:", ":8", "8:8", "9:8", "0:8,", "0:8,4:9", "0:8,8:9", "0:8 ", "a:b", "0:8;9:10"})
        EXPECT_THAT(ranges_of_text(text), IsEmpty()) << text;
}

TEST(Durations, AreReadInSecondsMinutesAndHours) {
    EXPECT_EQ(*parse_duration("90"), 90.0);
    EXPECT_EQ(*parse_duration("0.5s"), 0.5);
    EXPECT_EQ(*parse_duration("5m"), 300.0);
    EXPECT_EQ(*parse_duration("2h"), 7200.0);
    EXPECT_EQ(*parse_duration("8784h"), 366 * 24 * 3600.0);
    EXPECT_THAT(parse_duration("8785h").status.message, testing::HasSubstr("of a year at most"));
    for (const char* text : {"", "m", "0", "-1s", "5 m", "nan", "inf", "1e9h", "5d"})
        EXPECT_FALSE(parse_duration(text).ok()) << text;
}

/// Noise by the formula, worked out by hand: two pixels of luminance {1, 3} and {2, 2}. Standard errors are
/// sqrt(2 / 2) = 1 and 0, means 2: (1 / 2.01 + 0) / 2.
TEST(Noise, IsStandardErrorOverMean) {
    SampleSums sums(2, 1, true);
    EXPECT_TRUE(std::isinf(noise_of(sums)));
    for (const auto& [a, b] : {std::pair{1.0f, 2.0f}, std::pair{3.0f, 2.0f}}) {
        const glm::vec4 sample[2] = {glm::vec4(a), glm::vec4(b)};
        add_samples(std::span(sums.pixels), std::span(sums.squares), sample);
        ++sums.samples;
    }
    EXPECT_NEAR(noise_of(sums), 0.5 / 2.01, 1e-9);
}

Picture rendered(Options options, uint32_t seed, uint32_t samples, double* noise) {
    options.seed = seed;
    Console console(options, false, false);
    auto setup = set_up_scene(options, console);
    EXPECT_TRUE(setup.ok());
    CoreSession session(options, std::move(*setup), console);
    SampleSums sums(options.width, options.height, noise != nullptr);
    session.sum_into(&sums, 0);
    Picture scratch(options.width, options.height);
    EXPECT_TRUE(session.start({"target"}, scratch).ok());
    EXPECT_TRUE(session.render(render_system::Convergence::Converge, samples - 1).ok());
    EXPECT_EQ(sums.samples, samples);
    if (noise) *noise = noise_of(sums);
    return mean_picture(sums);
}

/// The estimate against the error itself: that of a picture against one of 32 times the samples and another seed. An
/// error of standard deviation s is on average s * sqrt(2 / pi) off.
TEST(Noise, AgreesWithTheTrueError) {
    Options options;
    options.quiet = true;
    options.scene = "still_life";
    options.width = 32;
    options.height = 18;
    const Picture truth = rendered(options, 7, 1024, nullptr);
    double estimate = 0.0, error = 0.0;
    const Picture picture = rendered(options, 0, 32, &estimate);
    const auto luminance = [](const glm::vec4& p) { return 0.2126 * p.x + 0.7152 * p.y + 0.0722 * p.z; };
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
        const double wanted = luminance(truth.pixels[i]);
        error += std::abs(luminance(picture.pixels[i]) - wanted) / (wanted + 0.01);
    }
    error *= std::sqrt(std::acos(-1.0) / 2.0) / static_cast<double>(picture.pixels.size());
    RecordProperty("estimate", std::to_string(estimate));
    RecordProperty("error", std::to_string(error));
    EXPECT_GT(estimate, 0.9 * error) << "noise that is not told";
    EXPECT_LT(estimate, 2.0 * error) << "the sequences gain less than that over chance";
}

}  // namespace
}  // namespace sampling_test
