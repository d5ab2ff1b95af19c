// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/kernels/intersect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace target_core;
using namespace target_core::kernels;

namespace {

TEST(Intersect, FindsAPlantedPointOfTheTriangle) {
    std::mt19937 generator(1);
    std::uniform_real_distribution<float> any(-5.0f, 5.0f);
    std::uniform_real_distribution<float> inside(0.02f, 0.48f);
    for (int i = 0; i < 20000; ++i) {
        vec3 v0(any(generator), any(generator), any(generator));
        vec3 v1(any(generator), any(generator), any(generator));
        vec3 v2(any(generator), any(generator), any(generator));
        float u = inside(generator);
        float v = inside(generator);
        vec3 target = (v0 * (1.0f - u - v) + v1 * u) + v2 * v;
        vec3 origin(any(generator), any(generator), 20.0f);
        vec3 way = target - origin;
        vec3 direction = normalized(way);
        vec3 normal = normalized(cross(v1 - v0, v2 - v0));
        if (std::fabs(dot(normal, direction)) < 0.05f ||
            std::sqrt(dot(cross(v1 - v0, v2 - v0), cross(v1 - v0, v2 - v0))) < 1.0f) {
            continue;  // grazing rays and slivers only measure rounding
        }
        TriangleTest test = intersect_triangle(origin, direction, v0, v1, v2);
        ASSERT_TRUE(test.hit);
        ASSERT_NEAR(test.u, u, 1e-3f);
        ASSERT_NEAR(test.v, v, 1e-3f);
        ASSERT_NEAR(test.t, std::sqrt(dot(way, way)), 1e-3f);
    }
}

TEST(Intersect, MissesBehindBesideAndDegenerate) {
    vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    vec3 down(0, 0, -1);
    EXPECT_TRUE(intersect_triangle(vec3(0.25f, 0.25f, 1), down, a, b, c).hit);
    EXPECT_TRUE(intersect_triangle(vec3(0.25f, 0.25f, 1), down, a, c, b).hit) << "both sides count";
    EXPECT_FALSE(intersect_triangle(vec3(0.25f, 0.25f, -1), down, a, b, c).hit) << "behind";
    EXPECT_FALSE(intersect_triangle(vec3(0.75f, 0.75f, 1), down, a, b, c).hit) << "beside";
    EXPECT_FALSE(intersect_triangle(vec3(0.25f, 0.25f, 1), vec3(1, 0, 0), a, b, c).hit) << "parallel";
    EXPECT_FALSE(intersect_triangle(vec3(0.25f, 0, 1), down, a, b, b).hit) << "no area";
}

TEST(Intersect, NoRaySlipsBetweenTheTrianglesOfAnEdge) {
    // A huge square of two triangles, looked at along its diagonal from close by, where rounding is at its worst.
    vec3 corners[4] = {vec3(-1000, -1000, 0), vec3(1000, -1000, 0), vec3(1000, 1000, 0), vec3(-1000, 1000, 0)};
    std::mt19937 generator(2);
    std::uniform_real_distribution<float> near(-5.0e-4f, 5.0e-4f);
    std::uniform_real_distribution<float> along(-900.0f, 900.0f);
    for (int i = 0; i < 200000; ++i) {
        vec3 origin(0.3f, 0.1f, 0.95f);
        float d = i % 2 == 0 ? 0.0f : along(generator);
        vec3 direction = normalized(vec3(d + near(generator), d + near(generator), 0.0f) - origin);
        bool first = intersect_triangle(origin, direction, corners[0], corners[1], corners[2]).hit;
        bool second = intersect_triangle(origin, direction, corners[0], corners[2], corners[3]).hit;
        ASSERT_TRUE(first || second) << i;
    }
}

TEST(Intersect, OffsetPointsClearTheirSurfaceAtAnyScale) {
    for (float scale : {1.0e-3f, 1.0f, 1.0e3f, 1.0e6f}) {
        vec3 p(0.7f * scale, -0.3f * scale, 0.01f * scale);
        vec3 n = normalized(vec3(1.0f, 2.0f, -3.0f));
        vec3 moved = offset_point(p, n);
        float distance = dot(moved - p, n);
        EXPECT_GT(distance, 0.0f) << scale;
        EXPECT_LT(distance, 1e-4f * std::max(scale, 1.0f)) << scale;
    }
}

TEST(Intersect, NormalsOfScaledAndMirroredInstancesStayPerpendicular) {
    vec4 row0(2.0f, 0.3f, 0.0f, 5.0f), row1(0.0f, -0.5f, 0.1f, 6.0f), row2(0.4f, 0.0f, 3.0f, 7.0f);
    vec3 tangent(1.0f, 2.0f, -1.0f);
    vec3 normal = cross(tangent, vec3(0.3f, -0.2f, 0.9f));
    vec3 world_tangent = transform_vector(row0, row1, row2, tangent);
    vec3 world_normal = transform_normal(row0, row1, row2, normal);
    EXPECT_NEAR(dot(world_tangent, world_normal), 0.0f, 1e-4f);
}

}  // namespace
