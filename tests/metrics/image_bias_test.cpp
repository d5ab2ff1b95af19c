// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
//
// The test for bias on simulated renders: pixels whose noise is as skewed as that of a path tracer, and means that are
// known because they were planted.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "metrics/image/bias.h"

namespace image_bias_test {
namespace {

using namespace metrics;

constexpr size_t kWidth = 24, kHeight = 16;

/// A small fast generator (Marsaglia's xorshift64*).
class Random {
public:
    explicit Random(uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u + 1) {}
    double unit() {
        state_ ^= state_ >> 12;
        state_ ^= state_ << 25;
        state_ ^= state_ >> 27;
        return static_cast<double>((state_ * 0x2545f4914f6cdd1du) >> 11) * 0x1p-53;
    }
    /// Mean 1; one in a hundred is a firefly that brings a third of the light.
    double light() {
        const double u = unit();
        return u < 0.01 ? 1e6 * u * u : 0.67340 * -std::log1p(-unit());
    }

private:
    uint64_t state_;
};

/// Sets of pictures of one scene, a ramp of light.
struct Renderer {
    Random random;
    double bias = 0;     ///< share of the mean, added to every pixel
    bool local = false;  ///< of the lower right quarter alone

    TileMeans render(size_t pictures) {
        TileMeans means({kWidth, kHeight, 8});
        std::vector<float> rgb(kWidth * kHeight * CHANNELS);
        for (size_t n = 0; n < pictures; ++n) {
            for (size_t i = 0; i < kWidth * kHeight; ++i) {
                const bool there = !local || (i % kWidth >= kWidth / 2 && i / kWidth >= kHeight / 2);
                const double light = (1 + static_cast<double>(i % kWidth)) * (random.light() + (there ? bias : 0));
                const auto grey = static_cast<float>(light);
                for (size_t c = 0; c < CHANNELS; ++c) rgb[i * CHANNELS + c] = grey;
            }
            means.add({kWidth, kHeight, rgb});
        }
        return means;
    }
};

TEST(TileMeans, AreMeansOfTilesAndOfTheWhole) {
    std::vector<float> rgb(10 * 9 * CHANNELS);
    for (size_t i = 0; i < 90; ++i)
        for (size_t c = 0; c < CHANNELS; ++c) rgb[i * CHANNELS + c] = static_cast<float>((i % 10) + 100 * c);
    rgb[CHANNELS * 9 + 1] = std::numeric_limits<float>::quiet_NaN();
    TileMeans means(sixteen_along(10, 9));
    means.add({10, 9, rgb});
    ASSERT_EQ(means.grid().side, 8u);
    ASSERT_EQ(means.grid().tiles(), 4u);
    EXPECT_EQ(means.pixels_left_out(), 1u);
    EXPECT_DOUBLE_EQ(means.values(0, 0)[0], 3.5);
    EXPECT_DOUBLE_EQ(means.values(1, 1)[0], 100 + (8 * 8 + 7 * 9) / 15.0) << "without the pixel that is none";
    EXPECT_DOUBLE_EQ(means.values(3, 2)[0], 208.5);
    EXPECT_DOUBLE_EQ(means.values(4, 0)[0], (9 * 45 - 9) / 89.0);
    EXPECT_EQ(sixteen_along(640, 360).side, 40u);
}

// Of 1,000 comparisons at alpha 0.001 one alarm is expected; six or more have a probability of 6e-4.
TEST(Bias, EqualRenderersRaiseAtMostFiveAlarmsInAThousandComparisons) {
    int alarms = 0, alarms_of_unequal_sets = 0;
    Renderer renderer{Random(1)};
    for (int i = 0; i < 1000; ++i) {
        const TileMeans a = renderer.render(16);
        alarms += test_bias(a, renderer.render(16)).verdict == BiasVerdict::differ ? 1 : 0;
        if (i % 4 == 0)
            alarms_of_unequal_sets += test_bias(a, renderer.render(40)).verdict == BiasVerdict::differ ? 1 : 0;
    }
    EXPECT_LE(alarms, 5);
    EXPECT_LE(alarms_of_unequal_sets, 3);
}

// What `detectable` promises, and what `samples_needed` says would do, holds in simulation.
TEST(Bias, ABiasThatIsDetectableIsFoundInNineOfTenComparisons) {
    Renderer equal{Random(2)};
    double detectable = 0;
    for (int i = 0; i < 10; ++i) detectable += 0.1 * *test_bias(equal.render(16), equal.render(16)).detectable;
    int found = 0;
    for (uint64_t i = 0; i < 100; ++i) {
        Renderer biased{Random(100 + i), detectable};
        const BiasTest test = test_bias(equal.render(16), biased.render(16));
        found += test.verdict == BiasVerdict::differ ? 1 : 0;
    }
    EXPECT_GE(found, 80);
    EXPECT_LE(found, 99) << "it promises less than it holds";
}

TEST(Bias, ALocalBiasIsFoundInItsTiles) {
    Renderer equal{Random(3)}, biased{Random(4), 2, true};
    const BiasTest test = test_bias(equal.render(32), biased.render(32));
    ASSERT_EQ(test.verdict, BiasVerdict::differ);
    ASSERT_EQ(test.tiles.size(), 6u);
    for (size_t tile = 0; tile < test.tiles.size(); ++tile) {
        const bool within = tile % 3 >= 1 && tile / 3 == 1;
        EXPECT_TRUE(within || !test.tiles[tile].differs) << tile;
    }
    EXPECT_GE(test.tiles_different, 1u);
    EXPECT_GT(test.mean_difference, 3 * test.standard_error);
}

TEST(Bias, TooFewPicturesSayHowManyWouldDo) {
    Renderer equal{Random(5)};
    const BiasTest one = test_bias(equal.render(1), equal.render(1));
    EXPECT_EQ(one.verdict, BiasVerdict::too_few);
    EXPECT_FALSE(one.samples_needed);
    const BiasQuestion question{.resolution = 0.1};
    const BiasTest few = test_bias(equal.render(16), equal.render(16), question);
    ASSERT_EQ(few.verdict, BiasVerdict::too_few);
    ASSERT_GT(*few.samples_needed, 1);
    const auto enough = static_cast<size_t>(std::ceil(16 * *few.samples_needed));
    const BiasTest test = test_bias(equal.render(enough), equal.render(enough), question);
    EXPECT_EQ(test.verdict, BiasVerdict::agree);
    EXPECT_LE(*test.detectable, 0.1);
    EXPECT_LE(*test.samples_needed, 1);
}

TEST(Bias, RoundingIsNoBiasAndWhatDoesNotScatterNeedsNoSamples) {
    TileMeans a({8, 8, 8}), rounded({8, 8, 8}), other({8, 8, 8});
    const std::vector<float> grey(8 * 8 * CHANNELS, 0.5f), nearly(grey.size(), 0.50001f), off(grey.size(), 0.505f);
    for (int i = 0; i < 16; ++i) {
        a.add({8, 8, grey});
        rounded.add({8, 8, nearly});
        other.add({8, 8, off});
    }
    EXPECT_EQ(test_bias(a, rounded).verdict, BiasVerdict::agree);
    EXPECT_EQ(test_bias(a, rounded).p_value, 1);
    EXPECT_EQ(test_bias(a, other).verdict, BiasVerdict::differ);
    EXPECT_EQ(test_bias(a, other).p_value, 0);
}

}  // namespace
}  // namespace image_bias_test
