// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render_system/host_scene.h"

namespace render_system::testing::camera_test {
namespace {

constexpr float DEGREE = 0.017453293f;

void expect_near(const glm::vec3& got, const glm::vec3& wanted, float tolerance = 1e-5f) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], tolerance) << "component " << i;
}

HostScene box_scene(const glm::vec3& lower, const glm::vec3& upper) {
    HostScene scene;
    scene.add_material(HostMaterial());
    HostMesh mesh;
    mesh.positions = {lower, upper, {lower.x, upper.y, upper.z}};
    mesh.normals.assign(3, glm::vec3(0, 0, 1));
    mesh.triangles = {{0, 1, 2, 0}};
    scene.add_instance(scene.add_mesh(mesh), CoreTransform());
    return scene;
}

TEST(Camera, ThePyramidKeepsTheVerticalAngleAndFollowsTheSize) {
    Camera camera;
    camera.position = {1, 2, 3};
    camera.vertical_fov = 90.0f * DEGREE;
    const ViewPyramid wide = view_pyramid(camera, 200, 100);
    EXPECT_EQ(wide.eye, glm::vec3(1, 2, 3));
    expect_near(wide.top_left, {-1, 3, 2});
    expect_near(wide.top_right, {3, 3, 2});
    expect_near(wide.bottom_left, {-1, 1, 2});
    const ViewPyramid tall = view_pyramid(camera, 50, 100);
    expect_near(tall.top_left, {0.5f, 3, 2});
}

TEST(Camera, WithALensTheScreenStandsAtTheFocus) {
    Camera camera;
    camera.vertical_fov = 90.0f * DEGREE;
    camera.aperture = 0.5f;
    camera.focus = 8.0f;
    const ViewPyramid view = view_pyramid(camera, 200, 100);
    expect_near(view.top_left, {-16, 8, -8});
    const Screen screen = screen_of(view, 100);
    expect_near(screen.lens_right, {0.5f, 0, 0});
    expect_near(screen.lens_down, {0, -0.5f, 0});
    camera.aperture = 0.0f;
    EXPECT_EQ(screen_of(view_pyramid(camera, 200, 100), 100).lens_right, glm::vec3(0.0f));
    EXPECT_NEAR(screen_of(view_pyramid(camera, 200, 100), 100).pixel_angle, screen.pixel_angle, 1e-9f);
}

TEST(Camera, OrthographicRaysStartAPixelApartAndGoOneWay) {
    Camera camera = look_at({0, 0, 1000}, {0, 0, 0}, {0, 1, 0}, 1.0f);
    camera.parallel_height = 4.0f;
    const ViewPyramid view = view_pyramid(camera, 200, 100);
    EXPECT_TRUE(view.parallel);
    const Screen screen = screen_of(view, 100);
    expect_near(screen.right, {8, 0, 0});
    expect_near(screen.down, {0, -4, 0});
    EXPECT_NEAR(screen.parallel_pixel, 0.04f, 1e-7f);
    EXPECT_EQ(screen.pixel_angle, 0.0f);
    expect_near(glm::normalize(screen.corner + 0.5f * (screen.right + screen.down)), {0, 0, -1});
}

TEST(Camera, LooksAtItsTarget) {
    const Camera camera = look_at({5, 0, 0}, {0, 0, 0}, {0, 3, 0}, 1.0f);
    expect_near(camera.forward, {-1, 0, 0});
    expect_near(camera.up, {0, 1, 0});
    expect_near(camera.right, {0, 0, -1});
    const Camera down = look_at({0, 5, 0}, {0, 0, 0}, {0, 1, 0}, 1.0f);
    expect_near(down.forward, {0, -1, 0});
    EXPECT_NEAR(glm::length(down.up), 1.0f, 1e-6f);
    EXPECT_NEAR(glm::dot(down.up, down.forward), 0.0f, 1e-6f);
}

// Where a point lands in a picture: -1 to 1 across and up.
glm::vec2 projected(const Camera& camera, float aspect, const glm::vec3& point) {
    const glm::vec3 way = point - camera.position;
    const float depth = glm::dot(way, camera.forward) * std::tan(0.5f * camera.vertical_fov);
    return {glm::dot(way, camera.right) / (depth * aspect), glm::dot(way, camera.up) / depth};
}

TEST(Camera, TheDefaultViewHoldsTheWholeBoxAndNoMore) {
    for (float aspect : {0.5f, 1.0f, 16.0f / 9.0f}) {
        for (const glm::vec3 size : {glm::vec3(1, 1, 1), glm::vec3(10, 1, 2), glm::vec3(1, 10, 30)}) {
            const glm::vec3 lower(3, -7, 11);
            const Camera camera = framing_camera(box_scene(lower, lower + size), aspect);
            expect_near(camera.forward, -glm::normalize(glm::vec3(1, 0.75f, 1.5f)), 1e-4f);
            EXPECT_NEAR(camera.right.y, 0.0f, 1e-6f);
            EXPECT_NEAR(camera.vertical_fov, 40.0f * DEGREE, 1e-6f);
            float widest = 0.0f;
            for (int corner = 0; corner < 8; ++corner) {
                const glm::vec3 point = lower + size * glm::vec3(corner & 1, corner >> 1 & 1, corner >> 2);
                const glm::vec2 place = glm::abs(projected(camera, aspect, point));
                widest = std::max(widest, std::max(place.x, place.y));
            }
            EXPECT_NEAR(widest, 1.0f, 1e-3f) << aspect;
        }
    }
}

TEST(Camera, TheDefaultViewOfASinglePointIsStillAView) {
    const Camera camera = framing_camera(box_scene({1, 1, 1}, {1, 1, 1}));
    EXPECT_GT(camera.position.z, 1.0f);
    expect_near(camera.forward, -glm::normalize(glm::vec3(1, 0.75f, 1.5f)));
    expect_near(framing_camera(HostScene()).forward, camera.forward);
    // As far off floats are 8 apart: the way is still the same one.
    const Camera far = framing_camera(box_scene(glm::vec3(1e8f), glm::vec3(1e8f)));
    EXPECT_GT(glm::dot(far.forward, camera.forward), 0.999f);
}

// Of an axis's plane: how far off it the default view of that box looks, in degrees.
float degrees_off(const glm::vec3& size, int axis) {
    const Camera camera = framing_camera(box_scene(glm::vec3(0.0f), size));
    return std::asin(-camera.forward[axis]) / DEGREE;
}

TEST(Camera, AFlatBoxIsSeenFromAtLeast30DegreesOffItsPlane) {
    EXPECT_NEAR(degrees_off({1, 1, 1}, 1), 22.6f, 0.1f);
    EXPECT_NEAR(degrees_off({10, 0, 10}, 1), 30.0f, 0.01f);
    EXPECT_NEAR(degrees_off({10, 0.5f, 20}, 1), 30.0f, 0.01f);
    EXPECT_NEAR(degrees_off({10, 2, 20}, 1), 22.6f, 0.1f) << "a box that is not flat";
    EXPECT_NEAR(degrees_off({0, 10, 10}, 0), 30.8f, 0.1f) << "as it is";
    EXPECT_NEAR(degrees_off({10, 10, 0}, 2), 50.2f, 0.1f);
}

}  // namespace
}  // namespace render_system::testing::camera_test
