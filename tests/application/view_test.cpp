// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What the window computes, without one: the camera that a person moves, picking, and how two pictures become one.
#include <gtest/gtest.h>

#include "application/view/composition.h"
#include "application/view/picking.h"
#include "application/view/view_camera.h"

namespace application {
namespace view_test {
namespace {

using render_system::Box;
using render_system::Camera;
using render_system::view_pyramid;
using render_system::ViewPyramid;

const Box BOX{{-1.0f, -1.0f, -1.0f}, {1.0f, 1.0f, 1.0f}};
constexpr float RIGHT_ANGLE = 1.57079633f;

Camera front() { return render_system::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, RIGHT_ANGLE); }

/// Where a point stands in the picture, by shares of its sides from the top left: a plain perspective projection.
glm::dvec2 place_of(const Camera& camera, const glm::dvec3& point, double aspect) {
    const glm::dvec3 way = point - glm::dvec3(camera.position);
    const double depth = glm::dot(way, glm::dvec3(camera.forward)),
                 half = depth * std::tan(0.5 * static_cast<double>(camera.vertical_fov));
    return {0.5 + 0.5 * glm::dot(way, glm::dvec3(camera.right)) / (half * aspect),
            0.5 - 0.5 * glm::dot(way, glm::dvec3(camera.up)) / half};
}

void expect_near(const glm::vec3& a, const glm::vec3& b, float within = 1e-4f) {
    EXPECT_LT(glm::length(a - b), within)
        << a.x << " " << a.y << " " << a.z << " for " << b.x << " " << b.y << " " << b.z;
}

TEST(ViewCamera, IsTheCameraItWasMadeOfUntilItMoves) {
    Camera rolled = front();
    std::swap(rolled.up, rolled.right);
    rolled.aperture = 0.25f;
    const Camera same = ViewCamera(rolled, BOX).camera();
    EXPECT_EQ(same.up, rolled.up);
    EXPECT_EQ(same.aperture, 0.25f);
}

TEST(ViewCamera, OrbitsAtOneDistanceAroundThePointLookedAt) {
    ViewCamera camera(front(), BOX);
    camera.orbit(RIGHT_ANGLE, 0.0);
    expect_near(camera.camera().position, {5, 0, 0});
    expect_near(camera.camera().forward, {-1, 0, 0});
    camera.orbit(0.0, 10.0);  // no farther than straight above
    EXPECT_GT(camera.camera().position.y, 4.99f);
    EXPECT_NEAR(glm::length(camera.camera().position), 5.0f, 1e-4f);
    EXPECT_NEAR(glm::length(camera.camera().right), 1.0f, 1e-5f);
    for (int i = 0; i < 1000; ++i) camera.orbit(0.7, i % 2 ? 0.3 : -0.3);
    EXPECT_NEAR(glm::length(camera.camera().position), 5.0f, 1e-3f);
}

TEST(ViewCamera, LooksAroundItsEyeFliesAndZooms) {
    ViewCamera camera(front(), BOX);
    camera.look(RIGHT_ANGLE, 0.0);
    expect_near(camera.camera().position, {0, 0, 5});
    expect_near(camera.camera().forward, {1, 0, 0});
    camera.fly(0.5, 0.0, 0.2);
    expect_near(camera.camera().position, {2.5f, 1.0f, 5.0f});
    ViewCamera zoomed(front(), BOX);
    zoomed.zoom(0.5);
    expect_near(zoomed.camera().position, {0, 0, 2.5f});
    for (int i = 0; i < 1000; ++i) zoomed.zoom(0.5);  // never through what it looks at
    EXPECT_GT(zoomed.camera().position.z, 0.0f);
}

TEST(ViewCamera, PansSoThatWhatIsLookedAtStaysUnderTheMouse) {
    ViewCamera camera(front(), BOX);
    camera.orbit(0.4, 0.3);
    const double aspect = 16.0 / 9.0;
    camera.pan(0.25, -0.125);  // shares of the height, to the right and down
    const glm::dvec2 place = place_of(camera.camera(), {0, 0, 0}, aspect);
    EXPECT_NEAR(place.x, 0.5 + 0.25 / aspect, 1e-4);
    EXPECT_NEAR(place.y, 0.5 + 0.125, 1e-4);
}

TEST(ViewCamera, FramesABoxSoThatAllOfItIsSeenAndLittleElse) {
    for (const double aspect : {16.0 / 9.0, 1.0, 0.4}) {
        ViewCamera camera(front(), BOX);
        camera.orbit(1.0, 0.5);
        const Box box{{10.0f, -3.0f, 4.0f}, {30.0f, 2.0f, 5.0f}};
        camera.frame(box, aspect);
        double widest = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 point((corner & 1) != 0 ? 30 : 10, (corner & 2) != 0 ? 2 : -3, (corner & 4) != 0 ? 5 : 4);
            const glm::dvec2 off = glm::abs(place_of(camera.camera(), point, aspect) - 0.5);
            widest = std::max({widest, off.x, off.y});
        }
        EXPECT_LT(widest, 0.5) << aspect;
        EXPECT_GT(widest, 0.15) << aspect;
    }
    ViewCamera camera(front(), BOX);
    camera.frame(Box(), 1.0);  // nothing to frame
    EXPECT_EQ(camera.camera().position, front().position);
}

/// Two triangles, one before the other, of one material each.
render_system::HostScene two_triangles() {
    render_system::HostScene scene;
    for (const char* name : {"near", "far"}) scene.add_material({name, {}});
    for (uint32_t i = 0; i < 2; ++i) {
        render_system::HostMesh mesh;
        const float z = i == 0 ? 1.0f : -1.0f, size = i == 0 ? 0.5f : 2.0f;
        mesh.name = i == 0 ? "front" : "back";
        mesh.positions = {{-size, -size, z}, {size, -size, z}, {0.0f, size, z}};
        mesh.triangles = {{0, 1, 2, i}};
        const uint32_t id = scene.add_mesh(std::move(mesh));
        render_system::HostNode node;
        node.name = i == 0 ? "" : "the far node";
        node.instance = scene.add_instance(id, {});
        scene.add_node(node);
    }
    return scene;
}

TEST(Picking, FindsTheNearestInstanceAndItsMaterial) {
    const render_system::HostScene scene = two_triangles();
    render_system::RayProbe probe(scene);
    const ViewPyramid view = view_pyramid(front(), 160, 90);
    const auto middle = pick(scene, probe, view, 0.5, 0.5);
    ASSERT_TRUE(middle);
    EXPECT_EQ(middle->instance, 0u);
    EXPECT_EQ(middle->node, "front");
    EXPECT_EQ(middle->material_name, "near");
    EXPECT_NEAR(middle->distance, 4.0, 1e-5);
    // (1.5, -1.8, -1) lies in the far triangle alone.
    const glm::dvec2 place = place_of(front(), {1.5, -1.8, -1.0}, 160.0 / 90.0);
    const auto beside = pick(scene, probe, view, place.x, place.y);
    ASSERT_TRUE(beside);
    EXPECT_EQ(beside->node, "the far node");
    EXPECT_EQ(beside->material_name, "far");
    EXPECT_FALSE(pick(scene, probe, view, 0.0, 0.0));
}

TEST(Picking, TakesParallelRaysOfAnOrthographicCamera) {
    Camera camera = front();
    camera.parallel_height = 4.0f;
    const PictureRay ray = ray_through(view_pyramid(camera, 200, 100), 0.75, 0.25);
    EXPECT_LT(glm::length(ray.direction - glm::dvec3(0, 0, -1)), 1e-6);
    EXPECT_LT(glm::length(ray.origin - glm::dvec3(2, 1, 5)), 1e-5);
}

TEST(Composition, ShowsOneBothOrTheirDifference) {
    const Channels<uint8_t> a{4, 1, {0, 0, 0, 10, 10, 10, 20, 20, 20, 30, 30, 30}};
    const Channels<uint8_t> b{2, 1, {1, 1, 1, 22, 20, 35}};  // as a coarse pass: half the size
    EXPECT_EQ(composed(a, b, {Show::One, 0.5f, 16}).rgb, a.rgb);
    EXPECT_EQ(composed(a, b, {Show::Split, 0.5f, 16}).rgb,
              (std::vector<uint8_t>{0, 0, 0, 10, 10, 10, 22, 20, 35, 22, 20, 35}));
    EXPECT_EQ(composed(a, b, {Show::Split, 0.0f, 16}).rgb, resized(b, 4, 1).rgb);
    EXPECT_EQ(composed(a, b, {Show::Split, 7.0f, 16}).rgb, a.rgb);
    EXPECT_EQ(composed(a, b, {Show::Difference, 0.5f, 10}).rgb,
              (std::vector<uint8_t>{10, 10, 10, 90, 90, 90, 20, 0, 150, 80, 100, 50}));
}

}  // namespace
}  // namespace view_test
}  // namespace application
