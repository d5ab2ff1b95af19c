// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Reprojection, function by function, against what geometry and colour say by themselves.
#include "target_core/kernels/reproject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>

namespace reproject_test {
namespace {

using target_core::bound;
using target_core::settings;
using target_core::vec4;
namespace kernels = target_core::kernels;

constexpr float WIDTH = 320.0f, HEIGHT = 180.0f;

vec4 row(const glm::dvec3& v, double w = 0.0) {
    return vec4(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w));
}

/// Two cameras 90 degrees wide that look along -z, the second from `eye`, turned about y by `turn`.
void look_from(const glm::dvec3& eye_before, double turn_before, const glm::dvec3& eye, double turn) {
    const auto camera = [](double angle, vec4& screen, vec4& right, vec4& down) {
        const glm::dvec3 x{std::cos(angle), 0, -std::sin(angle)}, z{std::sin(angle), 0, std::cos(angle)}, y{0, 1, 0};
        const double height = 2.0 * static_cast<double>(HEIGHT / WIDTH);
        screen = row(-z - x + y * (0.5 * height));
        right = row(x * 2.0);
        down = row(y * -height);
    };
    settings = {};
    settings.width = static_cast<uint32_t>(WIDTH);
    settings.height = static_cast<uint32_t>(HEIGHT);
    settings.eye = row(eye);
    settings.eye_before = row(eye_before);
    camera(turn, settings.screen, settings.screen_right, settings.screen_down);
    camera(turn_before, settings.screen_before, settings.screen_right_before, settings.screen_down_before);
    settings.motion = target_core::VIEW_MOVES;
}

kernels::Surface seen_at(const kernels::vec3& position, uint32_t instance) {
    kernels::Surface surface{};
    surface.position = position;
    surface.instance = instance;
    return surface;
}

// At a distance z the picture is 2 z wide: a step of the eye by x moves it by x / (2 z) of its width, the other way.
TEST(Motion, OfACameraThatStepsAsideGoesByDistance) {
    look_from({0, 0, 0}, 0, {0.5, -0.25, 0}, 0);
    for (const float distance : {1.0f, 4.0f, 50.0f}) {
        const auto motion = kernels::motion_of(seen_at({0.3f * distance, 0.2f * distance, -distance}, 0));
        EXPECT_NEAR(motion.x, 0.5f / (2.0f * distance) * WIDTH, 1e-3f) << distance;
        EXPECT_NEAR(motion.y, 0.25f / (2.0f * distance) * WIDTH, 1e-3f) << distance;
        EXPECT_NEAR(motion.z, 1.0f / distance, 1e-6f) << distance;
    }
}

TEST(Motion, OfACameraThatStepsBackShrinksThePictureAboutItsMiddle) {
    look_from({0, 0, 0}, 0, {0, 0, 2}, 0);
    const auto motion = kernels::motion_of(seen_at({1, 0.5f, -4}, 0));
    EXPECT_NEAR(motion.x, WIDTH / 2 * (1.0f / 4 - 1.0f / 6), 1e-3f);
    EXPECT_NEAR(motion.y, -WIDTH / 2 * (0.5f / 4 - 0.5f / 6), 1e-3f);
    EXPECT_NEAR(motion.z, 1.0f / 4, 1e-6f) << "how near it was then";
}

TEST(Motion, OfACameraThatTurnsIsTheTangentOfTheAngle) {
    const double turn = 0.1;
    look_from({0, 0, 0}, 0, {0, 0, 0}, turn);
    const auto motion = kernels::motion_of(seen_at({0, 0, -7}, 0));
    EXPECT_NEAR(motion.x, -WIDTH / 2 * static_cast<float>(std::tan(turn)), 1e-3f);
    EXPECT_NEAR(motion.y, 0.0f, 1e-3f);
}

TEST(Motion, OfAnInstanceIsThatOfItsMatrixAndWhatLayBehindTheEyeIsOutside) {
    look_from({0, 0, 0}, 0, {0, 0, 0}, 0);
    settings.motion = target_core::INSTANCES_MOVE;
    // Instance 0 stood still; 1 was 2 to the left and 1 farther off; 2 was behind the eye.
    const vec4 motions[] = {{1, 0, 0, 0},  {0, 1, 0, 0}, {0, 0, 1, 0}, {},           {1, 0, 0, -2}, {0, 1, 0, 0},
                            {0, 0, 1, -1}, {},           {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 9},  {}};
    bound.motions = motions;
    EXPECT_EQ(kernels::motion_of(seen_at({1, 1, -4}, 0)).x, 0.0f);
    const auto motion = kernels::motion_of(seen_at({1, 1, -4}, 1));
    EXPECT_NEAR(motion.x, WIDTH / 2 * (-1.0f / 5 - 1.0f / 4), 1e-3f);
    EXPECT_NEAR(motion.y, -WIDTH / 2 * (1.0f / 5 - 1.0f / 4), 1e-3f);
    EXPECT_NEAR(motion.z, 1.0f / 5, 1e-6f);
    EXPECT_LT(kernels::motion_of(seen_at({1, 1, -4}, 2)).x, -WIDTH);
}

// The corners of triangle 1 were 3 to the right of where they are by x = 3 u + v, y = v, and their instance was turned
// by 90 degrees about z and 1 farther off.
TEST(Motion, OfVerticesIsThatOfTheSamePlaceBetweenThem) {
    look_from({0, 0, 0}, 0, {0, 0, 0}, 0);
    settings.motion = target_core::VERTICES_MOVE;
    const auto bits = [](uint32_t word) { return vec4(std::bit_cast<float>(word), 0, 0, 0); };
    const vec4 motions[] = {{1, 0, 0, 2},  {0, 1, 0, 0}, {0, 0, 1, 0}, bits(0),      {0, -1, 0, 0}, {1, 0, 0, 0},
                            {0, 0, 1, -5}, bits(8),      {9, 9, 9, 0}, {4, 1, 0, 0}, {3, 0, 0, 0},  {6, 0, 0, 0}};
    const target_core::uvec4 triangles[] = {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {2, 3, 1, 0}};
    const vec4 instances[] = {{}, {}, {}, {}, {}, {}, {}, bits(2)};  // its mesh's triangles begin at row 2
    bound.motions = motions;
    bound.mesh_triangles = triangles;
    bound.instances = instances;
    kernels::Surface surface = seen_at({1, 1, -4}, 1);
    surface.primitive = 1;
    surface.u = 0.25f;
    surface.v = 0.5f;
    // There it was at x = 3 + 3 / 4 + 1 / 2, y = 1 / 2, then turned.
    const auto motion = kernels::motion_of(surface);
    EXPECT_NEAR(motion.x, WIDTH / 2 * (-0.5f / 5 - 1.0f / 4), 1e-3f);
    EXPECT_NEAR(motion.y, -WIDTH / 2 * (4.25f / 5 - 1.0f / 4), 1e-3f);
    EXPECT_NEAR(motion.z, 1.0f / 5, 1e-6f);
    EXPECT_NEAR(kernels::motion_of(seen_at({1, 1, -4}, 0)).x, WIDTH / 2 * (3.0f / 4 - 1.0f / 4), 1e-3f)
        << "the other one was 2 to the right";
}

TEST(Motion, OfParallelRaysKeepsItsSizeAtAnyDistance) {
    look_from({0, 0, 0}, 0, {0.25, 0, 0}, 0);
    settings.lens_down.w = 1.0f;
    settings.eye_before.w = 1.0f;
    for (const float distance : {2.0f, 9.0f}) {
        const auto motion = kernels::motion_of(seen_at({0.1f, 0.2f, -distance}, 0));
        EXPECT_NEAR(motion.x, 0.25f / 2.0f * WIDTH, 1e-3f);
        EXPECT_NEAR(motion.z, distance, 1e-5f);
    }
}

// Malvar and Sullivan's matrix, and its inverse by the definition of one.
TEST(Colour, OfYCoCgIsThatOfItsMatrixAndComesBack) {
    const auto green = kernels::to_ycocg({0, 1, 0}), red = kernels::to_ycocg({1, 0, 0}),
               blue = kernels::to_ycocg({0, 0, 1});
    EXPECT_FLOAT_EQ(red.x, 0.25f);
    EXPECT_FLOAT_EQ(red.y, 0.5f);
    EXPECT_FLOAT_EQ(red.z, -0.25f);
    EXPECT_FLOAT_EQ(green.x, 0.5f);
    EXPECT_FLOAT_EQ(green.y, 0.0f);
    EXPECT_FLOAT_EQ(green.z, 0.5f);
    EXPECT_FLOAT_EQ(blue.x, 0.25f);
    EXPECT_FLOAT_EQ(blue.y, -0.5f);
    EXPECT_FLOAT_EQ(blue.z, -0.25f);
    const auto back = kernels::from_ycocg(kernels::to_ycocg({0.7f, 0.2f, 5.0f}));
    EXPECT_NEAR(back.x, 0.7f, 1e-6f);
    EXPECT_NEAR(back.y, 0.2f, 1e-6f);
    EXPECT_NEAR(back.z, 5.0f, 1e-5f);
}

// On the line from the mean to the colour, where it leaves the box: found by bisection.
TEST(Colour, IsClippedWhereItsLineFromTheMeanLeavesTheBox) {
    kernels::Around around;
    around.mean = {0.5f, 0.1f, -0.05f};
    around.deviation = {0.2f, 0.05f, 0.1f};
    around.weights = 9.0f;
    const glm::dvec3 mean{0.5, 0.1, -0.05}, box = 1.5 * glm::dvec3(0.2, 0.05, 0.1);
    for (const glm::dvec3 rgb :
         {glm::dvec3{3, 0.5, 1}, glm::dvec3{0, 0, 0}, glm::dvec3{0.1, 2, 0.1}, glm::dvec3{0.55, 0.45, 0.4}}) {
        const glm::dvec3 colour{(rgb.r + rgb.b) / 4 + rgb.g / 2, (rgb.r - rgb.b) / 2, rgb.g / 2 - (rgb.r + rgb.b) / 4};
        double inside = 0.0, outside = 1.0;
        const auto is_inside = [&](double t) {
            const glm::dvec3 off = glm::abs((colour - mean) * t);
            return off.x <= box.x && off.y <= box.y && off.z <= box.z;
        };
        if (is_inside(1.0)) inside = 1.0;
        for (int i = 0; i < 50 && inside < 1.0; ++i) {
            const double middle = (inside + outside) / 2;
            (is_inside(middle) ? inside : outside) = middle;
        }
        const glm::dvec3 expected = mean + (colour - mean) * inside;
        const auto found = kernels::to_ycocg(kernels::clipped(
            {static_cast<float>(rgb.r), static_cast<float>(rgb.g), static_cast<float>(rgb.b)}, around));
        const double slack = 0.01;  // the box is a thousandth of the mean larger, for means without any deviation
        EXPECT_NEAR(static_cast<double>(found.x), expected.x, slack * box.x + 1e-3);
        EXPECT_NEAR(static_cast<double>(found.y), expected.y, slack * box.x + 1e-3);
        EXPECT_NEAR(static_cast<double>(found.z), expected.z, slack * box.x + 1e-3);
    }
}

// A kernel of third order: what is a polynomial of degree 2 it finds again anywhere.
TEST(CatmullRom, InterpolatesParabolasExactly) {
    for (const float t : {0.0f, 0.25f, 0.5f, 0.9f}) {
        const auto weights = kernels::catmull_rom(t);
        const auto parabola = [](float x) { return 1.0f + 2.0f * x - 3.0f * x * x; };
        const float found =
            weights.x * parabola(-1) + weights.y * parabola(0) + weights.z * parabola(1) + weights.w * parabola(2);
        EXPECT_NEAR(found, parabola(t), 1e-5f) << t;
    }
}

}  // namespace
}  // namespace reproject_test
