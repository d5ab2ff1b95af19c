// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/kernels/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

using namespace target_core;
using namespace target_core::kernels;

namespace {

// The second Sobol dimension from its direction numbers v[k] = v[k-1] ^ (v[k-1] >> 1) (Kollig and Keller 2002).
uint sobol_second_by_directions(uint index) {
    uint result = 0;
    for (uint v = 1u << 31; index != 0; index >>= 1, v ^= v >> 1) {
        result ^= (index & 1u) != 0 ? v : 0u;
    }
    return result;
}

TEST(Random, SecondSobolDimensionIsTheOneOfItsDirectionNumbers) {
    for (uint index = 0; index < 100000; ++index) {
        ASSERT_EQ(bitfieldReverse(sobol_second_reversed(index)), sobol_second_by_directions(index));
    }
    ASSERT_EQ(bitfieldReverse(sobol_second_reversed(0xdeadbeefu)), sobol_second_by_directions(0xdeadbeefu));
}

TEST(Random, OwenScrambledPairsFillEveryElementaryIntervalOnce) {
    // A (0, 2)-sequence stays one under Owen scrambling and under nested shuffling of its index.
    for (uint pair = 0; pair < 8; ++pair) {
        for (uint log_x = 0; log_x <= 8; ++log_x) {
            uint columns = 1u << log_x;
            uint rows = 1u << (8 - log_x);
            std::set<std::pair<uint, uint>> cells;
            for (uint sample = 0; sample < 256; ++sample) {
                vec2 u = random_pair(pixel_seed(123, 7), sample, pair);
                cells.insert({static_cast<uint>(u.x * static_cast<float>(columns)),
                              static_cast<uint>(u.y * static_cast<float>(rows))});
            }
            ASSERT_EQ(cells.size(), 256u) << "pair " << pair << ", " << columns << " columns";
        }
    }
}

TEST(Random, NumbersStayBelowOne) {
    EXPECT_LT(unit_float(0xFFFFFFFFu), 1.0f);
    EXPECT_EQ(unit_float(0u), 0.0f);
}

TEST(Random, PairsSamplesAndPixelsAreIndependent) {
    // Correlation of the first number of two streams over many pixels, as a z-value.
    auto z_value = [](auto&& a, auto&& b) {
        constexpr uint N = 100000;
        double sum = 0.0;
        for (uint i = 0; i < N; ++i) {
            sum += (a(i) - 0.5) * (b(i) - 0.5);
        }
        return sum / std::sqrt(N) * 12.0;
    };
    auto number = [](uint pixel, uint sample, uint pair) { return random_pair(pixel_seed(pixel, 0), sample, pair).x; };
    EXPECT_LT(std::fabs(z_value([&](uint i) { return number(i, 0, 0); }, [&](uint i) { return number(i, 0, 1); })),
              4.0);
    EXPECT_LT(std::fabs(z_value([&](uint i) { return number(i, 0, 0); }, [&](uint i) { return number(i + 1, 0, 0); })),
              4.0);
    EXPECT_LT(std::fabs(z_value([&](uint i) { return number(i, 0, 5); },
                                [&](uint i) { return random_pair(pixel_seed(i, 0), 0, 5).y; })),
              4.0);
    EXPECT_LT(std::fabs(z_value([&](uint i) { return number(i, 0, 0); },
                                [&](uint i) { return random_pair(pixel_seed(i, 1), 0, 0).x; })),
              4.0);
}

}  // namespace
