// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0

// The loader on whole scenes: the project's own, and the larger ones that lie beside a checkout where they are at hand.

#include <gmock/gmock.h>

#include "render_system/core_checks.h"
#include "render_system/light_table.h"
#include "render_system/scene_loader.h"

namespace render_system::testing::whole_scenes_test {
namespace {

using ::testing::IsEmpty;

std::filesystem::path shared_scene(const char* name) { return std::filesystem::path(SHARED_SCENES) / name; }

void expect_sound(const HostScene& scene) {
    for (const HostMesh& mesh : scene.meshes()) EXPECT_TRUE(validate_mesh(mesh.view()).ok());
    for (const HostTexture& texture : scene.textures()) EXPECT_TRUE(validate_texture(texture.view()).ok());
}

void expect_near(const glm::vec3& got, const glm::vec3& wanted, float tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], tolerance) << "component " << i;
}

TEST(WholeScenes, StillLife) {
    const Result<LoadedScene> result = load_scene(std::filesystem::path(OWN_SCENES) / "still_life/still_life.gltf");
    ASSERT_TRUE(result.ok()) << result.status.message;
    EXPECT_THAT(result->warnings, IsEmpty());
    EXPECT_GT(result->scene.triangle_count(), 0u);
    EXPECT_TRUE(result->scene.has_light());
    expect_sound(result->scene);
}

// Numbers from the scene's own description.
TEST(WholeScenes, Pica) {
    const std::filesystem::path path = shared_scene("pica/scene.gltf");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no scene at " << path << " (PORTTOOL_SHARED_SCENES)";
    Result<LoadedScene> result = load_scene(path);
    ASSERT_TRUE(result.ok()) << result.status.message;
    HostScene& scene = result->scene;
    EXPECT_THAT(result->warnings, IsEmpty());
    EXPECT_EQ(scene.triangle_count(), 76274u);
    EXPECT_EQ(scene.materials().size(), 28u);
    EXPECT_EQ(scene.textures().size(), 6u);
    EXPECT_TRUE(scene.cameras().empty());
    EXPECT_FALSE(scene.has_light());
    expect_near(scene.bounds().lower, {-36.9f, -1.2f, -32.2f}, 0.05f);
    expect_near(scene.bounds().upper, {27.4f, 18.5f, 18.2f}, 0.05f);
    expect_sound(scene);

    const Result<CameraFile> camera = load_camera_file(shared_scene("pica/camera.json"));
    ASSERT_TRUE(camera.ok()) << camera.status.message;
    EXPECT_EQ(camera->sky_radiance, glm::vec3(1));
    ASSERT_EQ(camera->area_lights.size(), 1u);
    ASSERT_TRUE(add_area_light(scene, camera->area_lights[0]).ok());
    const LightTable table = build_light_table(scene, 0.0);
    EXPECT_EQ(table.lights.size(), 2u);
    EXPECT_NEAR(table.total_weight, 6.9f * 6.9f * luminance({100, 100, 80}), 1.0f);
}

TEST(WholeScenes, Kitchen) {
    const std::filesystem::path path = shared_scene("kitchen/scene.gltf");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no scene at " << path << " (PORTTOOL_SHARED_SCENES)";
    const Result<LoadedScene> result = load_scene(path);
    ASSERT_TRUE(result.ok()) << result.status.message;
    const HostScene& scene = result->scene;
    EXPECT_THAT(result->warnings, IsEmpty());
    EXPECT_EQ(scene.triangle_count(), 1443517u);
    EXPECT_EQ(scene.meshes().size(), 299u);
    EXPECT_EQ(scene.materials().size(), 88u);
    EXPECT_EQ(scene.textures().size(), 11u);
    expect_sound(scene);
    EXPECT_EQ(build_light_table(scene, 0.0).lights.size(), 8u);
    // The camera node and the camera file describe one view.
    const Result<CameraFile> file = load_camera_file(shared_scene("kitchen/camera.json"));
    ASSERT_TRUE(file.ok()) << file.status.message;
    ASSERT_EQ(scene.cameras().size(), 1u);
    const Camera& node = scene.cameras()[0].camera;
    expect_near(node.position, file->camera.position, 1e-4f);
    expect_near(node.forward, file->camera.forward, 1e-3f);
    expect_near(node.up, file->camera.up, 1e-3f);
    EXPECT_NEAR(node.vertical_fov, file->camera.vertical_fov, 1e-4f);
}

}  // namespace
}  // namespace render_system::testing::whole_scenes_test
