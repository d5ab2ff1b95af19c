// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "target_core/kernels/lights.h"
#include "target_core/kernels/path_state.h"

using namespace target_core;
using namespace target_core::kernels;

namespace {

TEST(LightSampling, TrianglePointsAreUniform) {
    // Chi-square over the 64 congruent sub-triangles of an 8-fold subdivision.
    constexpr int N = 8;
    constexpr int SAMPLES = 64000;
    std::vector<int> count(N * N, 0);
    for (uint i = 0; i < SAMPLES; ++i) {
        vec2 b = sample_triangle(random_pair(pixel_seed(i, 3), 0, 0));
        ASSERT_GE(b.x, 0.0f);
        ASSERT_GE(b.y, 0.0f);
        ASSERT_LE(b.x + b.y, 1.0f + 1e-6f);
        int x = std::min(N - 1, static_cast<int>(b.x * N));
        int y = std::min(N - 1 - x, static_cast<int>(b.y * N));
        bool upper = (b.x * N - static_cast<float>(x)) + (b.y * N - static_cast<float>(y)) > 1.0f && x + y < N - 1;
        // Row y holds 2 * (N - y) - 1 sub-triangles.
        count[static_cast<size_t>(y * (2 * N - y) + 2 * x + (upper ? 1 : 0))] += 1;
    }
    double expected = static_cast<double>(SAMPLES) / (N * N);
    double chi2 = 0.0;
    for (int c : count) {
        chi2 += (c - expected) * (c - expected) / expected;
    }
    EXPECT_LT(chi2, 103.4) << "63 degrees of freedom, 0.1 %";
}

TEST(LightSampling, SkyCoordinatesAndDirectionsAreInverse) {
    for (int i = 0; i < 20000; ++i) {
        vec2 u = random_pair(pixel_seed(static_cast<uint>(i), 5), 0, 0);
        u.y = 0.001f + 0.998f * u.y;
        vec2 back = sky_coordinates(sky_direction(u));
        ASSERT_NEAR(back.x, u.x, 1e-4f);
        ASSERT_NEAR(back.y, u.y, 1e-4f);
    }
    vec3 centre = sky_direction(vec2(0.5f, 0.5f));
    EXPECT_NEAR(centre.z, -1.0f, 1e-6f) << "the centre of the map looks along -z";
    vec3 right = sky_direction(vec2(0.75f, 0.5f));
    EXPECT_NEAR(right.x, 1.0f, 1e-6f);
    vec3 top = sky_direction(vec2(0.5f, 0.0f));
    EXPECT_NEAR(top.y, 1.0f, 1e-6f) << "row 0 is at +y";
}

TEST(LightSampling, PowerHeuristicSharesSumToOne) {
    for (float a : {1e-10f, 0.3f, 1.0f, 7.0f, 1e15f}) {
        for (float b : {1e-10f, 0.2f, 1.0f, 9.0f, 1e15f}) {
            EXPECT_NEAR(power_heuristic(a, b) + power_heuristic(b, a), 1.0f, 1e-6f) << a << " " << b;
        }
    }
    EXPECT_EQ(power_heuristic(2.0f, 0.0f), 1.0f);
    EXPECT_NEAR(power_heuristic(1.0f, 2.0f), 0.2f, 1e-6f);
}

}  // namespace
