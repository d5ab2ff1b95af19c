// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/source_core/test_scene.h"

#include <unistd.h>

#include <fstream>

#include "source_core/device/kernel_files.h"

namespace source_core_test {

using namespace render_system;

namespace {

std::string open_error;

float number(std::mt19937& random, float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
}

glm::vec3 point(std::mt19937& random, float half_side) {
    return {number(random, -half_side, half_side), number(random, -half_side, half_side),
            number(random, -half_side, half_side)};
}

}  // namespace

void TestMesh::add_triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c, uint32_t material) {
    const auto first = static_cast<uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c});
    triangles.push_back({first, first + 1, first + 2, material});
}

CoreMesh TestMesh::view() {
    normals.assign(positions.size(), glm::vec3(0.0f, 0.0f, 1.0f));
    CoreMesh mesh;
    mesh.positions = positions;
    mesh.normals = normals;
    mesh.uv0 = uv;
    mesh.triangles = triangles;
    return mesh;
}

Status TestScene::send(CoreAPI& core) {
    Status status = core.SetMaterials(0, materials);
    for (uint32_t i = 0; i < meshes.size() && status.ok(); ++i) {
        status = core.SetGeometry(i, meshes[i].view());
    }
    for (uint32_t i = 0; i < instances.size() && status.ok(); ++i) {
        status = core.SetInstance(i, instances[i].mesh, instances[i].transform);
    }
    return status;
}

TestMesh random_mesh(uint32_t triangles, float half_side, float size, std::mt19937& random) {
    TestMesh mesh;
    for (uint32_t i = 0; i < triangles; ++i) {
        const glm::vec3 centre = point(random, half_side);
        const float extent = size * number(random, 0.1f, 1.0f);
        mesh.add_triangle(centre + point(random, extent), centre + point(random, extent),
                          centre + point(random, extent));
    }
    return mesh;
}

CoreTransform random_transform(float spread, bool mirrored, std::mt19937& random) {
    const float angle = number(random, 0.0f, 6.28f);
    const glm::vec3 scale(number(random, 0.2f, 2.0f), number(random, 0.2f, 2.0f), number(random, 0.2f, 2.0f));
    const glm::vec3 moved = point(random, spread);
    CoreTransform transform;
    transform.rows[0] = {std::cos(angle) * scale.x, -std::sin(angle) * scale.y, 0.1f, moved.x};
    transform.rows[1] = {std::sin(angle) * scale.x, std::cos(angle) * scale.y, -0.2f, moved.y};
    transform.rows[2] = {0.05f, 0.3f, mirrored ? -scale.z : scale.z, moved.z};
    return transform;
}

Status send_feature_scene(CoreAPI& core) {
    const std::vector<uint32_t> checker = {0xFF2040FFu, 0x20FFFFFFu, 0x20FFFFFFu, 0xFF804020u, 0x80808080u};
    CoreTexture texture;
    texture.width = texture.height = 2;
    texture.levels = 2;
    texture.texels = checker;
    CoreMaterial plain;
    plain.base_color_texture.texture = 0;
    plain.metallic_roughness_texture.texture = 0;
    plain.normal_texture.texture = 0;
    plain.specular_texture.texture = 0;
    plain.specular_texture.uv_set = 2;
    plain.sheen_color = glm::vec3(0.5f);
    plain.coat = 0.5f;
    plain.film = 0.5f;
    plain.anisotropy = 0.5f;
    plain.sheen_color_texture.texture = 0;
    CoreMaterial leaf;
    leaf.opaque = false;
    leaf.alpha_cutoff = 0.5f;
    leaf.base_color_texture.texture = 0;
    CoreMaterial veil;
    veil.opaque = false;
    veil.alpha = 0.5f;
    CoreMaterial glass;
    glass.transmission = 1.0f;
    glass.thin_walled = false;
    glass.absorption = glm::vec3(0.5f);
    CoreMaterial lamp;
    lamp.emission = glm::vec3(4.0f);
    lamp.emission_texture.texture = 0;
    lamp.emission_weight = 4.0f;

    TestScene scene;
    scene.materials = {plain, leaf, veil, glass, lamp};
    std::mt19937 random(7);
    for (uint32_t m = 0; m < 5; ++m) {
        scene.meshes.push_back(random_mesh(40, 0.8f, 0.5f, random));
        for (auto& triangle : scene.meshes.back().triangles) {
            triangle.w = m;
        }
        for (size_t i = 0; i < scene.meshes.back().positions.size(); ++i) {
            scene.meshes.back().uv.push_back({static_cast<float>(i % 3), static_cast<float>(i % 2)});
        }
        scene.instances.push_back({m, {}});
    }
    scene.instances.push_back({1, random_transform(0.5f, true, random)});
    scene.instances.push_back({2, random_transform(0.5f, false, random)});

    CoreLight emitter;
    emitter.kind = LightKind::triangle;
    std::copy_n(scene.meshes[4].positions.begin(), 3, emitter.vertices);
    emitter.emission = glm::vec3(4.0f);
    emitter.emission_texture.texture = 0;
    CoreLight lantern;
    lantern.kind = LightKind::spot;
    lantern.vertices[0] = {0.0f, 0.0f, 2.0f};
    lantern.emission = glm::vec3(3.0f);
    CoreLight sky_light;
    sky_light.kind = LightKind::sky;
    const std::vector<CoreLight> lights = {emitter, lantern, sky_light};
    const std::vector<AliasEntry> table(3, AliasEntry{1.0f, 0, 1.0f / 3.0f});
    const std::vector<glm::vec4> texels(8, glm::vec4(0.5f, 0.7f, 1.0f, 0.0f));
    const std::vector<AliasEntry> texel_table(8, AliasEntry{1.0f, 0, 0.125f});
    CoreSky sky;
    sky.width = 4;
    sky.height = 2;
    sky.texels = texels;
    sky.table = texel_table;
    sky.light_probability = 1.0f / 3.0f;

    Status status = core.SetTextures(std::span(&texture, 1));
    status = status.ok() ? scene.send(core) : status;
    status = status.ok() ? core.SetLights({lights, table, 3.0f}) : status;
    return status.ok() ? core.SetSkyData(sky) : status;
}

ViewPyramid front_view() {
    ViewPyramid view;
    view.eye = {0.0f, 0.0f, 4.0f};
    view.top_left = {-1.0f, 1.0f, 1.0f};
    view.top_right = {1.0f, 1.0f, 1.0f};
    view.bottom_left = {-1.0f, -1.0f, 1.0f};
    return view;
}

const std::string& last_open_error() { return open_error; }

std::unique_ptr<CoreAPI> open_core(const source_core::SourceOptions& options, const source_core::CoreTuning& tuning) {
    auto core = source_core::create_tuned_core(tuning, options);
    const Status status = core->Init({});
    if (!status.ok()) {
        open_error = status.message;
        EXPECT_EQ(status.code, StatusCode::no_device) << status.message;
        return nullptr;
    }
    return core;
}

std::vector<glm::vec4> render(CoreAPI& core, uint32_t width, uint32_t height, uint32_t samples) {
    std::vector<glm::vec4> pixels(size_t{width} * height, glm::vec4(-1.0f));
    Status status = core.SetTarget({width, height, pixels});
    EXPECT_TRUE(status.ok()) << status.message;
    status = core.Render(front_view(), Convergence::Restart, samples);
    EXPECT_TRUE(status.ok()) << status.message;
    return pixels;
}

TemporaryFolder::TemporaryFolder() {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("source_core_test_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
}

void TemporaryFolder::write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
}

void TemporaryFolder::write_kernels() const {
    for (unsigned i = 0; i < source_core::EMBEDDED_KERNEL_COUNT; ++i) {
        write(std::string(source_core::EMBEDDED_KERNELS[i].name), std::string(source_core::EMBEDDED_KERNELS[i].text));
    }
}

}  // namespace source_core_test
