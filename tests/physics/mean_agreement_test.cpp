// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/photometer.h"

using namespace physics;
using namespace render_system;

namespace {

using MeanAgreement = OnEveryCore;

// |a - b| in standard errors, for two independent readings.
double z_value(const Reading& a, const Reading& b) {
    return std::fabs(a.mean - b.mean) / std::sqrt(a.error * a.error + b.error * b.error);
}

// An open box with a light, a rough metal sphere and a glossy floor.
HostScene little_room() {
    HostScene scene;
    uint32_t white = scene.add_material(lambert(0.7f));
    HostMaterial glossy;
    glossy.core.base_color = {0.2f, 0.5f, 0.3f};
    glossy.core.metallic = 0.0f;
    glossy.core.roughness = 0.4f;
    uint32_t floor = scene.add_material(glossy);
    HostMaterial metal;
    metal.core.base_color = {0.9f, 0.7f, 0.4f};
    metal.core.roughness = 0.5f;
    uint32_t sphere = scene.add_material(metal);
    uint32_t light = scene.add_material(emitter(12.0f));
    place(scene, quad_mesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, floor));
    place(scene, quad_mesh({-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, white));
    place(scene, quad_mesh({-2, 0, 2}, {0, 0, -4}, {0, 3, 0}, white));
    place(scene, quad_mesh({-0.5f, 2.9f, -0.5f}, {1, 0, 0}, {0, 0, 1}, light));
    HostMesh ball = sphere_mesh(0.6f, 16, sphere);
    for (glm::vec3& p : ball.positions) {
        p += glm::vec3(0.4f, 0.6f, 0.0f);
    }
    place(scene, std::move(ball));
    return scene;
}

void with_and_without(const char* core, const HostScene& scene) {
    Exposure exposure;
    exposure.size = 64;
    exposure.samples = 8;
    exposure.max_path_length = 5;
    ViewPyramid view = square_view({0.5f, 1.5f, 6.0f}, {0, 1.2f, 0}, 0.7f);
    Reading on = measure(core, scene, view, exposure);
    exposure.next_event_estimation = false;
    exposure.samples = 32;
    Reading off = measure(core, scene, view, exposure);
    EXPECT_GT(on.mean, 0.05);
    EXPECT_LT(z_value(on, off), 3.5) << on.mean << " +- " << on.error << ", " << off.mean << " +- " << off.error;
}

TEST_P(MeanAgreement, NextEventEstimationOfTrianglesKeepsTheMean) { with_and_without(GetParam(), little_room()); }

TEST_P(MeanAgreement, NextEventEstimationOfASkyMapKeepsTheMean) {
    HostScene scene = little_room();
    Sky sky;
    sky.width = 32;
    sky.height = 16;
    sky.texels.assign(32 * 16, glm::vec4(0.3f, 0.4f, 0.6f, 1.0f));
    for (uint32_t row = 3; row < 6; ++row) {
        for (uint32_t column = 14; column < 18; ++column) {
            sky.texels[row * 32 + column] = glm::vec4(20.0f, 18.0f, 15.0f, 1.0f);
        }
    }
    scene.set_sky(sky);
    with_and_without(GetParam(), scene);
}

// A Lambert floor under an emitter with alpha.
void floor_under(const char* core, const HostMaterial& light, const HostTexture* texture) {
    HostScene scene;
    HostMaterial lamp = light;
    if (texture) {
        lamp.core.base_color_texture.texture = scene.add_texture(*texture);
    }
    uint32_t floor = scene.add_material(lambert(0.7f));
    uint32_t emitting = scene.add_material(lamp);
    place(scene, quad_mesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, floor));
    place(scene, quad_mesh({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, emitting));
    Exposure exposure;
    exposure.size = 64;
    exposure.max_path_length = 2;
    ViewPyramid view = square_view({0.0f, 1.5f, 4.0f}, {0, 0, 0}, 0.3f);
    Reading on = measure(core, scene, view, exposure);
    exposure.next_event_estimation = false;
    Reading off = measure(core, scene, view, exposure);
    double spread = std::sqrt(on.error * on.error + off.error * off.error);
    EXPECT_NEAR(on.mean, off.mean, 3.5 * spread + 1e-9);
}

TEST_P(MeanAgreement, EmittersWithAlphaShineWithWhatItLeavesOfThem) {
    HostMaterial light = emitter(8.0f);
    light.core.opaque = false;
    light.core.alpha = 0.4f;
    floor_under(GetParam(), light, nullptr);
    light.core.alpha_cutoff = 0.5f;
    floor_under(GetParam(), light, nullptr);
    light.core.alpha = 1.0f;
    HostTexture holes;
    holes.width = 2;
    holes.height = 2;
    holes.nearest = true;
    holes.texels = {0xFFFFFFFFu, 0x00FFFFFFu, 0x00FFFFFFu, 0xFFFFFFFFu};
    floor_under(GetParam(), light, &holes);
    light.core.alpha_cutoff = 0.0f;
    floor_under(GetParam(), light, &holes);
}

TEST_P(MeanAgreement, AnEvenSkyMapEqualsAConstantSky) {
    HostScene scene = little_room();
    Exposure exposure;
    exposure.size = 64;
    exposure.samples = 16;
    ViewPyramid view = square_view({0.5f, 1.5f, 6.0f}, {0, 1.2f, 0}, 0.7f);
    set_sky(scene, 0.8f);
    Reading constant = measure(GetParam(), scene, view, exposure);
    Sky sky;
    sky.width = 64;
    sky.height = 32;
    sky.texels.assign(64 * 32, glm::vec4(0.8f, 0.8f, 0.8f, 1.0f));
    scene.set_sky(sky);
    Reading map = measure(GetParam(), scene, view, exposure);
    EXPECT_LT(z_value(constant, map), 3.5) << constant.mean << ", " << map.mean;
}

INSTANTIATE_TEST_SUITE_P(Cores, MeanAgreement, testing::Values("target", "source"),
                         [](const auto& core) { return std::string(core.param); });

}  // namespace
