// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "render_system/core_api.h"
#include "source_core/core_tuning.h"

namespace source_core_test {

/// A mesh that owns its data; normals are +z, which no test here looks at.
struct TestMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec4> triangles;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uv;

    void add_triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c, uint32_t material = 0);
    render_system::CoreMesh view();
};

struct TestInstance {
    uint32_t mesh = 0;
    render_system::CoreTransform transform;
};

/// Meshes, instances and materials, ready to be handed to a core.
struct TestScene {
    std::vector<TestMesh> meshes;
    std::vector<TestInstance> instances;
    std::vector<render_system::CoreMaterial> materials{render_system::CoreMaterial{}};

    /// Hands everything to the core; stops at the first failure.
    render_system::Status send(render_system::CoreAPI& core);
};

/// Triangles of random size around random places in a cube of that half side.
TestMesh random_mesh(uint32_t triangles, float half_side, float size, std::mt19937& random);

render_system::CoreTransform random_transform(float spread, bool mirrored, std::mt19937& random);

/// A scene with every feature that kernels compile for: instances, alpha by texture and by factor, textures, normal
/// maps, transmission, emitters, punctual lights and a sky map.
render_system::Status send_feature_scene(render_system::CoreAPI& core);

/// A view of the cube [-1, 1]^3 from +z.
render_system::ViewPyramid front_view();

/// A core through Init, or null with the reason printed as the test's skip message.
std::unique_ptr<render_system::CoreAPI> open_core(const source_core::SourceOptions& options = {},
                                                  const source_core::CoreTuning& tuning = {});

/// Renders and returns the pixels; fails the test on an error.
std::vector<glm::vec4> render(render_system::CoreAPI& core, uint32_t width, uint32_t height, uint32_t samples);

/// A folder of its own, removed at the end.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    const std::filesystem::path& path() const { return path_; }
    /// Writes a file into the folder.
    void write(const std::string& name, const std::string& text) const;
    /// Writes out all kernels that are built into the program.
    void write_kernels() const;

private:
    std::filesystem::path path_;
};

}  // namespace source_core_test

/// Opens `core` or skips the test with the reason.
#define OPEN_CORE_OR_SKIP(core, ...)                         \
    auto core = source_core_test::open_core(__VA_ARGS__);    \
    if (!core) {                                             \
        GTEST_SKIP() << source_core_test::last_open_error(); \
    }

namespace source_core_test {
const std::string& last_open_error();
}
