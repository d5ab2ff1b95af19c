// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
//
// The image metrics against scikit-image 0.19.3. The figures in CASES were printed by
// `/usr/bin/python3 tests/metrics/reference_values.py`, which makes its images by the same integer formulas as
// stand here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "metrics/image/error.h"
#include "metrics/image/ssim.h"

namespace image_metrics_test {
namespace {

using metrics::ImageView8;
using metrics::ImageViewFloat;
using Pattern = std::function<int(int, int, int)>;

int hash_noise(int x, int y, int channel) {
    uint32_t h = (static_cast<uint32_t>(x) * 73856093u) ^ (static_cast<uint32_t>(y) * 19349663u) ^
                 (static_cast<uint32_t>(channel) * 83492791u);
    h *= 2654435761u;
    return static_cast<int>(h >> 24);
}

int pattern(int x, int y, int channel) {
    const int ramp = (x * (channel + 2) + y * 3) / 4;
    const int check = (x / 7 + y / 5) % 2 != 0 ? 60 : 0;
    return (ramp + check) % 256;
}

Pattern noisy(int strength) {
    return [strength](int x, int y, int channel) {
        const int offset = (hash_noise(x, y, channel) * (2 * strength + 1)) / 256 - strength;
        return std::clamp(pattern(x, y, channel) + offset, 0, 255);
    };
}

int one_sided(int x, int y, int channel) {
    return channel == 0 && x < 40 ? 255 - pattern(x, y, channel) : pattern(x, y, channel);
}

struct Image {
    size_t width = 0;
    size_t height = 0;
    std::vector<uint8_t> rgb;

    Image(int width_in, int height_in, const Pattern& value)
        : width(static_cast<size_t>(width_in)), height(static_cast<size_t>(height_in)) {
        for (int y = 0; y < height_in; ++y) {
            for (int x = 0; x < width_in; ++x) {
                for (int c = 0; c < 3; ++c) rgb.push_back(static_cast<uint8_t>(value(x, y, c)));
            }
        }
    }
    ImageView8 view() const { return {width, height, rgb}; }
};

struct Case {
    const char* name;
    int width, height;
    Pattern first, second;
    double ssim, rmse, psnr, pixels_off;
};

const std::vector<Case>& cases() {
    static const std::vector<Case> all = {
        {"noise of 3 levels", 97, 61, pattern, noisy(3), 0.997329807308, 1.999042078072, 42.114364894079,
         0.922764914653},
        {"noise of 60 levels", 97, 61, pattern, noisy(60), 0.561059762529, 34.036725402584, 17.491848190297, 1.0},
        {"unrelated", 64, 64, pattern, hash_noise, 0.001622207833, 96.745141458542, 8.418220329326, 1.0},
        {"one channel, one half", 80, 45, pattern, one_sided, 0.747935197593, 64.241759811696, 11.974455022407, 0.5},
        {"smallest", 11, 11, pattern, noisy(20), 0.942489073036, 10.709667114200, 27.535284169097, 1.0},
        {"one row of windows", 40, 11, pattern, noisy(20), 0.931335384959, 11.309020266758, 27.062303961401, 1.0},
        {"black and white", 16, 16, [](int, int, int) { return 0; }, [](int, int, int) { return 255; }, 0.000099990001,
         255.0, 0.0, 1.0},
    };
    return all;
}

// The bar is 1e-4; the formulas are the same, so only the order of the sums is left to differ.
constexpr double TOLERANCE = 1e-9;

TEST(ImageMetrics, AgreeWithScikitImage) {
    for (const Case& c : cases()) {
        SCOPED_TRACE(c.name);
        const Image a(c.width, c.height, c.first);
        const Image b(c.width, c.height, c.second);
        EXPECT_NEAR(metrics::ssim(a.view(), b.view()).value(), c.ssim, TOLERANCE);
        EXPECT_NEAR(metrics::rmse(a.view(), b.view()), c.rmse, TOLERANCE);
        EXPECT_NEAR(metrics::psnr(a.view(), b.view()).value(), c.psnr, TOLERANCE);
        EXPECT_NEAR(metrics::pixels_off(a.view(), b.view()), c.pixels_off, TOLERANCE);
    }
}

TEST(ImageMetrics, AreSymmetric) {
    const Image a(50, 40, pattern);
    const Image b(50, 40, noisy(30));
    EXPECT_DOUBLE_EQ(metrics::ssim(a.view(), b.view()).value(), metrics::ssim(b.view(), a.view()).value());
    EXPECT_DOUBLE_EQ(metrics::rmse(a.view(), b.view()), metrics::rmse(b.view(), a.view()));
    EXPECT_DOUBLE_EQ(metrics::pixels_off(a.view(), b.view()), metrics::pixels_off(b.view(), a.view()));
}

TEST(ImageMetrics, OfIdenticalImagesAreExact) {
    const Image a(64, 48, noisy(40));
    EXPECT_EQ(metrics::ssim(a.view(), a.view()), 1.0);
    EXPECT_EQ(metrics::rmse(a.view(), a.view()), 0.0);
    EXPECT_EQ(metrics::psnr(a.view(), a.view()), std::nullopt);
    EXPECT_EQ(metrics::pixels_off(a.view(), a.view()), 0.0);
}

TEST(Ssim, IsNoneBelowElevenPixels) {
    for (const auto& [width, height] : {std::pair{10, 11}, std::pair{11, 10}, std::pair{1, 1}, std::pair{0, 0}}) {
        const Image image(width, height, pattern);
        EXPECT_EQ(metrics::ssim(image.view(), image.view()), std::nullopt) << width << "x" << height;
    }
}

TEST(Ssim, LeavesOutTheBordersOnlyAsWindowCentres) {
    // A window reaches 5 pixels from its centre, so a corner pixel counts in exactly one window.
    Image a(20, 20, pattern);
    Image b = a;
    b.rgb[0] = static_cast<uint8_t>(255 - b.rgb[0]);
    const double whole = metrics::ssim(a.view(), b.view()).value();
    EXPECT_LT(whole, 1.0);
    EXPECT_GT(whole, 0.999);
}

TEST(Ssim, OfFullHdTakesLessThanASecondOrSo) {
    const Image a(1920, 1080, pattern);
    const Image b(1920, 1080, noisy(5));
    const auto start = std::chrono::steady_clock::now();
    EXPECT_LT(metrics::ssim(a.view(), b.view()).value(), 1.0);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    // A window evaluated tap by tap takes 121 reads a pixel and half a minute; the bound leaves room for a busy
    // machine.
    EXPECT_LT(seconds.count(), 10.0);
}

TEST(PixelsOff, CountsPixelsNotChannelsAndAllowsOneLevel) {
    Image a(4, 1, [](int, int, int) { return 100; });
    Image b = a;
    b.rgb[0] = 101;                 // pixel 0: one level, not counted
    b.rgb[3] = 102, b.rgb[4] = 98;  // pixel 1: two channels, counted once
    b.rgb[8] = 255;                 // pixel 2: last channel
    EXPECT_DOUBLE_EQ(metrics::pixels_off(a.view(), b.view()), 0.5);
}

TEST(RmseLinear, IsTakenOverAllChannels) {
    const std::vector<float> a = {0.0f, 0.0f, 0.0f, 1.0f, 2.0f, 3.0f};
    const std::vector<float> b = {3.0f, 0.0f, 0.0f, 1.0f, 2.0f, -1.0f};
    EXPECT_DOUBLE_EQ(metrics::rmse_linear({2, 1, a}, {2, 1, b}), std::sqrt(25.0 / 6.0));
}

TEST(IdenticalPixels, ComparesBits) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> a = {0.0f, 1.0f, 2.0f, nan, 1.0f, 2.0f, 1.0f, 1.0f, 1.0f, 5.0f, 6.0f, 7.0f};
    std::vector<float> b = a;
    EXPECT_EQ(metrics::identical_pixels({4, 1, a}, {4, 1, b}), 1.0);
    b[0] = -0.0f;
    EXPECT_EQ(metrics::identical_pixels({4, 1, a}, {4, 1, b}), 0.75);
    b[8] = std::nextafter(1.0f, 2.0f);
    EXPECT_EQ(metrics::identical_pixels({4, 1, a}, {4, 1, b}), 0.5);
}

}  // namespace
}  // namespace image_metrics_test
