// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The functions that stand for a device's divisions and roots, read as C++ and held against the processor's own, which
// rounds as IEEE 754 has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/integer.hpp>
#include <random>
#include <vector>

namespace {

// The text, as member functions: unused ones raise no warning.
namespace glsl_words {
using glm::findMSB;
using glm::floatBitsToUint;
using glm::uintBitsToFloat;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using std::max;
using std::min;
using uint = uint32_t;
#define in
struct Text {
#include "source_core/device/exact_arithmetic.glsl"
};
#undef in
}  // namespace glsl_words

glsl_words::Text glsl;

uint32_t bits_of(float x) { return std::bit_cast<uint32_t>(x); }

// Any NaN is as good as another.
bool same(float a, float b) { return bits_of(a) == bits_of(b) || (std::isnan(a) && std::isnan(b)); }

// Both ends of every kind of number, with their neighbours, in both signs.
std::vector<float> edges() {
    std::vector<float> result;
    for (const uint32_t at : {0x00000000u, 0x00000001u, 0x00400000u, 0x00800000u, 0x00800001u, 0x01000000u, 0x3f000000u,
                              0x3f7fffffu, 0x3f800000u, 0x3f800001u, 0x3fffffffu, 0x40400000u, 0x7effffffu, 0x7f000000u,
                              0x7f7fffffu, 0x7f800000u, 0x7fc00000u}) {
        for (const uint32_t step : {0u, 1u, 2u, 3u}) {
            for (const uint32_t sign : {0u, 0x80000000u}) {
                result.push_back(std::bit_cast<float>((at + step) | sign));
                result.push_back(std::bit_cast<float>((at - std::min(at, step)) | sign));
            }
        }
    }
    return result;
}

}  // namespace

TEST(ExactArithmetic, DividesEdgesAsTheProcessorDoes) {
    for (const float a : edges()) {
        for (const float b : edges()) {
            ASSERT_TRUE(same(glsl.exact_quotient(a, b), a / b))
                << std::hexfloat << a << " / " << b << " is " << a / b << ", not " << glsl.exact_quotient(a, b);
        }
    }
}

TEST(ExactArithmetic, DividesAnyBitsAsTheProcessorDoes) {
    std::mt19937 random(1);
    for (int i = 0; i < 1'000'000; ++i) {
        const float a = std::bit_cast<float>(static_cast<uint32_t>(random()));
        const float b = std::bit_cast<float>(static_cast<uint32_t>(random()));
        ASSERT_TRUE(same(glsl.exact_quotient(a, b), a / b))
            << std::hexfloat << a << " / " << b << " is " << a / b << ", not " << glsl.exact_quotient(a, b);
    }
}

TEST(ExactArithmetic, RoundsQuotientsThatAreDenormal) {
    std::mt19937 random(2);
    int denormal = 0;
    for (int i = 0; i < 200'000; ++i) {
        const float a = std::bit_cast<float>(static_cast<uint32_t>(random()) & 0x00ffffffu);
        const float b = std::bit_cast<float>(0x3f800000u | (static_cast<uint32_t>(random()) & 0x027fffffu));
        denormal += std::fpclassify(a / b) == FP_SUBNORMAL;
        ASSERT_TRUE(same(glsl.exact_quotient(a, b), a / b)) << std::hexfloat << a << " / " << b;
    }
    EXPECT_GT(denormal, 50'000) << "the test would not notice";
}

TEST(ExactArithmetic, TakesRootsAsTheProcessorDoes) {
    for (const float x : edges()) {
        ASSERT_TRUE(same(glsl.exact_root(x), std::sqrt(x))) << std::hexfloat << x;
    }
    std::mt19937 random(3);
    for (int i = 0; i < 1'000'000; ++i) {
        const float x = std::bit_cast<float>(static_cast<uint32_t>(random()));
        ASSERT_TRUE(same(glsl.exact_root(x), std::sqrt(x)))
            << std::hexfloat << x << " has the root " << std::sqrt(x) << ", not " << glsl.exact_root(x);
    }
}

TEST(ExactArithmetic, TakesTheFirstOfEqualsAsTheTargetCoreDoes) {
    EXPECT_EQ(bits_of(glsl.exact_smaller(0.0f, -0.0f)), bits_of(0.0f));
    EXPECT_EQ(bits_of(glsl.exact_larger(-0.0f, 0.0f)), bits_of(-0.0f));
    EXPECT_EQ(glsl.exact_clamped(3.0f, 0.0f, 1.0f), 1.0f);
    EXPECT_EQ(glsl.exact_clamped(-3.0f, 0.0f, 1.0f), 0.0f);
    EXPECT_EQ(glsl.exact_clamped(0.25f, 0.0f, 1.0f), 0.25f);
}
