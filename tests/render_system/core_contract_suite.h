// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "render_system/alias_table.h"
#include "render_system/core_api.h"

// What core_api.h promises, held against a core. For a core of its own, a test writes
//
//     struct SourceCore {
//         static std::unique_ptr<CoreAPI> create();
//         static constexpr int EDITS = 1000;  // how many random ones it is put through
//         static CoreOptions options();
//     };
//     INSTANTIATE_TYPED_TEST_SUITE_P(Source, CoreContractSuite, SourceCore);
//
// A core without a device on this machine skips with its own reasons.

namespace render_system::testing {

/// Two triangles in front of the camera that fill most of the picture, in memory of its own.
struct ContractScene {
    std::vector<glm::vec3> positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    std::vector<glm::vec3> normals = std::vector<glm::vec3>(4, glm::vec3(0, 0, 1));
    std::vector<glm::vec2> uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    std::vector<glm::uvec4> triangles = {{0, 1, 2, 0}, {0, 2, 3, 0}};
    std::vector<uint32_t> texels = {0xFF0000FFu, 0xFF00FF00u, 0xFFFF0000u, 0xFFFFFFFFu, 0xFF808080u};
    std::vector<CoreMaterial> materials = std::vector<CoreMaterial>(1);
    std::vector<CoreLight> lights = std::vector<CoreLight>(1);
    std::vector<AliasEntry> table = {{1.0f, 0, 1.0f}};

    ContractScene() {
        materials[0].base_color_texture.texture = 0;
        lights[0].kind = LightKind::point;
        lights[0].vertices[0] = glm::vec3(0, 0, 2);
        lights[0].emission = glm::vec3(5);
    }

    CoreMesh mesh() const {
        CoreMesh mesh;
        mesh.positions = positions;
        mesh.normals = normals;
        mesh.uv0 = uv0;
        mesh.triangles = triangles;
        return mesh;
    }

    CoreTexture texture() const {
        CoreTexture texture;
        texture.width = 2;
        texture.height = 2;
        texture.levels = 2;
        texture.texels = texels;
        return texture;
    }

    CoreLights light_table() const { return {lights, table, 4.0f}; }

    static CoreSky sky() {
        CoreSky sky;
        sky.radiance = glm::vec3(0.5f);
        return sky;
    }
};

inline ViewPyramid contract_view() {
    ViewPyramid view;
    view.eye = {0, 0, 3};
    view.top_left = {-0.5f, 0.5f, 2};
    view.top_right = {0.5f, 0.5f, 2};
    view.bottom_left = {-0.5f, -0.5f, 2};
    return view;
}

template <class Core>
class CoreContractSuite : public ::testing::Test {
protected:
    static constexpr uint32_t SIDE = 16;

    void SetUp() override { core_ = Core::create(); }

    /// Init, or a skip if this machine cannot run the core.
    bool opened() {
        const Status status = core_->Init(Core::options());
        if (status.ok()) return true;
        EXPECT_EQ(status.code, StatusCode::no_device) << status.message;
        return false;
    }

    void send(const ContractScene& scene) {
        const CoreTexture texture = scene.texture();
        expect_ok(core_->SetTextures({&texture, 1}));
        expect_ok(core_->SetMaterials(0, scene.materials));
        expect_ok(core_->SetGeometry(0, scene.mesh()));
        expect_ok(core_->SetInstance(0, 0, CoreTransform()));
        expect_ok(core_->SetLights(scene.light_table()));
        expect_ok(core_->SetSkyData(ContractScene::sky()));
        expect_ok(core_->Setting(CoreSettings()));
    }

    CoreTarget target(uint32_t side = SIDE) {
        pixels_.assign(static_cast<size_t>(side) * side, glm::vec4(std::numeric_limits<float>::quiet_NaN()));
        return {side, side, pixels_};
    }

    std::vector<glm::vec4> render(uint32_t samples = 1, Convergence convergence = Convergence::Restart) {
        expect_ok(core_->Render(contract_view(), convergence, samples));
        for (const glm::vec4& pixel : pixels_) {
            EXPECT_TRUE(std::isfinite(pixel.x + pixel.y + pixel.z));
            EXPECT_EQ(pixel.w, 1.0f);
        }
        return pixels_;
    }

    static void expect_ok(const Status& status) { EXPECT_TRUE(status.ok()) << status.message; }

    static void expect_refused(const Status& status, StatusCode code = StatusCode::invalid_argument) {
        EXPECT_EQ(status.code, code) << status.message;
        EXPECT_FALSE(status.message.empty());
    }

    /// Every call but Init answers wrong_order.
    void expect_all_refused() {
        const ContractScene scene;
        const CoreTexture texture = scene.texture();
        expect_refused(core_->SetTarget(target()), StatusCode::wrong_order);
        expect_refused(core_->Setting(CoreSettings()), StatusCode::wrong_order);
        expect_refused(core_->SetTextures({&texture, 1}), StatusCode::wrong_order);
        expect_refused(core_->SetMaterials(0, scene.materials), StatusCode::wrong_order);
        expect_refused(core_->SetLights(scene.light_table()), StatusCode::wrong_order);
        expect_refused(core_->SetSkyData(ContractScene::sky()), StatusCode::wrong_order);
        expect_refused(core_->SetGeometry(0, scene.mesh()), StatusCode::wrong_order);
        expect_refused(core_->SetInstance(0, NONE, CoreTransform()), StatusCode::wrong_order);
        expect_refused(core_->SetWatch(nullptr), StatusCode::wrong_order);
        expect_refused(core_->Render(contract_view(), Convergence::Restart, 1), StatusCode::wrong_order);
    }

    std::unique_ptr<CoreAPI> core_;
    std::vector<glm::vec4> pixels_;
};

#define SKIP_WITHOUT_DEVICE() \
    if (!this->opened()) GTEST_SKIP() << "no device for this core"

TYPED_TEST_SUITE_P(CoreContractSuite);

TYPED_TEST_P(CoreContractSuite, NothingWorksBeforeInitOrAfterShutdown) {
    this->expect_all_refused();
    SKIP_WITHOUT_DEVICE();
    this->expect_refused(this->core_->Init(TypeParam::options()), StatusCode::wrong_order);
    this->core_->Shutdown();
    this->expect_all_refused();
    this->core_->Shutdown();
}

TYPED_TEST_P(CoreContractSuite, StatisticsAreZeroBeforeTheFirstRender) {
    SKIP_WITHOUT_DEVICE();
    const CoreStats stats = this->core_->GetCoreStats();
    EXPECT_EQ(stats.samples, 0u);
    EXPECT_EQ(stats.primary_rays + stats.extension_rays + stats.shadow_rays, 0u);
    EXPECT_EQ(stats.total_ms, 0.0);
}

TYPED_TEST_P(CoreContractSuite, RendersAndCounts) {
    SKIP_WITHOUT_DEVICE();
    this->send(ContractScene());  // gone before the first Render: a core copies
    this->expect_ok(this->core_->SetTarget(this->target()));
    this->render(3);
    const CoreStats stats = this->core_->GetCoreStats();
    EXPECT_FALSE(stats.core.empty());
    EXPECT_FALSE(stats.device.empty());
    EXPECT_EQ(stats.samples, 3u);
    EXPECT_EQ(stats.triangles, 2u);
    EXPECT_EQ(stats.primary_rays, 3u * this->SIDE * this->SIDE);
}

TYPED_TEST_P(CoreContractSuite, ShowsEveryPathAfterEveryKernelAndRendersTheSame) {
    SKIP_WITHOUT_DEVICE();
    this->send(ContractScene());
    this->expect_ok(this->core_->SetTarget(this->target()));
    const std::vector<glm::vec4> unwatched = this->render(2);
    struct Counter final : PathWatch {
        std::atomic<uint64_t> generated = 0, finished = 0, steps = 0;
        void after(const PathStates& states) override {
            ++steps;
            if (states.kernel == PathKernel::generate) generated += states.path_count;
            if (states.kernel == PathKernel::finalize) finished += states.means.size() / 4;
        }
    } counter;
    this->expect_ok(this->core_->SetWatch(&counter));
    EXPECT_EQ(this->render(2), unwatched);
    const uint64_t paths = counter.steps == 0 ? 0 : 2u * this->SIDE * this->SIDE;
    EXPECT_EQ(counter.generated, paths);
    EXPECT_EQ(counter.finished, paths);
    EXPECT_EQ(counter.steps == 0, this->core_->GetKernelTexts().empty()) << "what runs kernels shows their paths";
    this->expect_ok(this->core_->SetWatch(nullptr));
    const uint64_t steps = counter.steps;
    this->render(1);
    EXPECT_EQ(counter.steps, steps);
}

TYPED_TEST_P(CoreContractSuite, ConvergeAddsAndRestartDrops) {
    SKIP_WITHOUT_DEVICE();
    this->send(ContractScene());
    this->expect_ok(this->core_->SetTarget(this->target()));
    const std::vector<glm::vec4> first = this->render(1);
    this->render(2, Convergence::Converge);
    EXPECT_EQ(this->core_->GetCoreStats().samples, 3u);
    EXPECT_EQ(this->render(1), first);
    EXPECT_EQ(this->core_->GetCoreStats().samples, 1u);
}

TYPED_TEST_P(CoreContractSuite, SamplesTakenInPartsGiveTheSamePicture) {
    SKIP_WITHOUT_DEVICE();
    this->send(ContractScene());
    this->expect_ok(this->core_->SetTarget(this->target()));
    const std::vector<glm::vec4> whole = this->render(4);
    this->render(1);
    EXPECT_EQ(this->render(3, Convergence::Converge), whole);
}

/// Sums taken in parts of the picture and of the samples, in any order, are those of all at once, to the bit.
TYPED_TEST_P(CoreContractSuite, SumsOfPartsAreTheSumOfTheWhole) {
    SKIP_WITHOUT_DEVICE();
    this->send(ContractScene());
    CoreTarget target = this->target();
    this->expect_ok(this->core_->SetTarget(target));
    const std::vector<glm::vec4> means = this->render(5);
    std::vector<PixelSum> whole(means.size()), parts(means.size());
    std::vector<double> squares(means.size());
    target.sums = whole;
    target.squares = squares;
    this->expect_ok(this->core_->SetTarget(target));
    this->expect_ok(this->core_->Render(contract_view(), Convergence::Restart, 5));
    const auto add_part = [&](uint32_t pixel, size_t pixels, uint32_t sample, uint32_t samples) {
        std::vector<PixelSum> part(pixels);
        CoreSettings settings;
        settings.first_sample = sample;
        target.sums = part;
        target.squares = {};
        target.first_pixel = pixel;
        this->expect_ok(this->core_->Setting(settings));
        this->expect_ok(this->core_->SetTarget(target));
        this->expect_ok(this->core_->Render(contract_view(), Convergence::Restart, samples));
        for (size_t i = 0; i < pixels; ++i) add_sum(parts[pixel + i], part[i]);
    };
    add_part(100, means.size() - 100, 3, 2);
    add_part(0, 100, 0, 5);
    add_part(100, means.size() - 100, 0, 3);
    EXPECT_EQ(parts, whole);
    for (size_t i = 0; i < means.size(); ++i) {
        const glm::vec3 mean = mean_of(whole[i], 5);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(mean[channel], means[i][channel], 1e-6f * std::abs(mean[channel])) << "pixel " << i;
        const double luminance = 0.2126 * mean.x + 0.7152 * mean.y + 0.0722 * mean.z;
        EXPECT_GE(squares[i], 5.0 * luminance * luminance * (1.0 - 1e-6)) << "the mean of squares is no less";
    }
    target.first_pixel = 1;
    target.sums = whole;
    this->expect_refused(this->core_->SetTarget(target));
    target.first_pixel = 0;
    target.squares = std::span(squares).first(1);
    this->expect_refused(this->core_->SetTarget(target));
}

/// Whenever it is called off, what comes next begins anew, as if it had never been asked for.
TYPED_TEST_P(CoreContractSuite, ARenderThatIsCalledOffDropsTheSamples) {
    SKIP_WITHOUT_DEVICE();
    this->send(ContractScene());
    CoreTarget target = this->target();
    this->expect_ok(this->core_->SetTarget(target));
    const std::vector<glm::vec4> whole = this->render(3);
    bool is_finished = false;
    uint32_t times = 0;
    for (uint32_t after = 0; !is_finished; after = 2 * after + 1, ++times) {
        target.is_called_off = {};
        this->expect_ok(this->core_->SetTarget(target));
        this->render(1);
        std::atomic<uint32_t> asked = 0;
        target.is_called_off = [&asked, after] { return ++asked > after; };
        this->expect_ok(this->core_->SetTarget(target));
        const Status status = this->core_->Render(contract_view(), Convergence::Converge, 2);
        is_finished = status.ok();
        if (is_finished) break;
        EXPECT_EQ(status.code, StatusCode::called_off) << status.message;
        EXPECT_LE(asked, after + std::max(1u, std::thread::hardware_concurrency())) << "one of each thread at most";
        EXPECT_EQ(this->core_->GetCoreStats().samples, 0u);
        target.is_called_off = {};
        this->expect_ok(this->core_->SetTarget(target));
        EXPECT_EQ(this->render(3, Convergence::Converge), whole) << after;
    }
    EXPECT_GE(times, 1u);
    EXPECT_EQ(this->pixels_, whole);
}

TYPED_TEST_P(CoreContractSuite, NoSamplesAreRefusedAndLeaveThePicture) {
    SKIP_WITHOUT_DEVICE();
    this->send(ContractScene());
    this->expect_ok(this->core_->SetTarget(this->target()));
    const std::vector<glm::vec4> before = this->render(2);
    this->expect_refused(this->core_->Render(contract_view(), Convergence::Converge, 0));
    EXPECT_EQ(this->pixels_, before);
    EXPECT_EQ(this->core_->GetCoreStats().samples, 2u);
}

TYPED_TEST_P(CoreContractSuite, ATargetOfAnotherSizeStartsAnew) {
    SKIP_WITHOUT_DEVICE();
    this->send(ContractScene());
    this->expect_ok(this->core_->SetTarget(this->target()));
    this->render(2);
    this->expect_ok(this->core_->SetTarget(this->target(7)));
    this->render(1, Convergence::Converge);
    EXPECT_EQ(this->core_->GetCoreStats().samples, 1u);
    EXPECT_EQ(this->core_->GetCoreStats().primary_rays, 49u);
}

TYPED_TEST_P(CoreContractSuite, AnEmptySceneIsAllSky) {
    SKIP_WITHOUT_DEVICE();
    this->expect_ok(this->core_->SetTarget(this->target()));
    const std::vector<glm::vec4> pixels = this->render();
    for (const glm::vec4& pixel : pixels) EXPECT_EQ(pixel, pixels[0]);
    EXPECT_EQ(this->core_->GetCoreStats().triangles, 0u);
}

TYPED_TEST_P(CoreContractSuite, RefusesTargetsAndSettingsThatMakeNoSense) {
    SKIP_WITHOUT_DEVICE();
    CoreTarget target = this->target();
    target.width = 0;
    this->expect_refused(this->core_->SetTarget(target));
    target = this->target();
    target.height = 0;
    this->expect_refused(this->core_->SetTarget(target));
    target = this->target();
    target.pixels = target.pixels.first(target.pixels.size() - 1);
    this->expect_refused(this->core_->SetTarget(target));
    CoreSettings settings;
    settings.max_path_length = 0;
    this->expect_refused(this->core_->Setting(settings));
    this->expect_refused(this->core_->Render(contract_view(), Convergence::Restart, 1), StatusCode::wrong_order);
}

TYPED_TEST_P(CoreContractSuite, RefusesTexturesThatAreNoMipChain) {
    SKIP_WITHOUT_DEVICE();
    const ContractScene scene;
    for (uint32_t levels : {0u, 1u, 3u}) {
        CoreTexture texture = scene.texture();
        texture.levels = levels;
        this->expect_refused(this->core_->SetTextures({&texture, 1}));
    }
    CoreTexture texture = scene.texture();
    texture.width = 0;
    this->expect_refused(this->core_->SetTextures({&texture, 1}));
}

TYPED_TEST_P(CoreContractSuite, RefusesGapsInNumberedThings) {
    SKIP_WITHOUT_DEVICE();
    const ContractScene scene;
    this->expect_refused(this->core_->SetMaterials(1, scene.materials));
    this->expect_refused(this->core_->SetGeometry(1, scene.mesh()));
    this->expect_refused(this->core_->SetInstance(1, NONE, CoreTransform()));
    this->send(scene);
    this->expect_refused(this->core_->SetMaterials(2, scene.materials));
    this->expect_ok(this->core_->SetMaterials(1, scene.materials));
    this->expect_ok(this->core_->SetGeometry(1, scene.mesh()));
    this->expect_ok(this->core_->SetInstance(1, 1, CoreTransform()));
}

TYPED_TEST_P(CoreContractSuite, RefusesMeshesThatContradictThemselves) {
    SKIP_WITHOUT_DEVICE();
    ContractScene scene;
    scene.triangles[1].y = 4;
    this->expect_refused(this->core_->SetGeometry(0, scene.mesh()));
    scene = ContractScene();
    CoreMesh mesh = scene.mesh();
    mesh.normals = mesh.normals.first(3);
    this->expect_refused(this->core_->SetGeometry(0, mesh));
    mesh = scene.mesh();
    mesh.uv0 = mesh.uv0.first(1);
    this->expect_refused(this->core_->SetGeometry(0, mesh));
    const std::vector<glm::vec4> tangents(5);
    mesh = scene.mesh();
    mesh.tangents = tangents;
    this->expect_refused(this->core_->SetGeometry(0, mesh));
    const std::vector<glm::vec4> colors(3);
    mesh = scene.mesh();
    mesh.colors = colors;
    this->expect_refused(this->core_->SetGeometry(0, mesh));
}

TYPED_TEST_P(CoreContractSuite, RefusesInstancesOfNothingAndMatricesThatAreNotFinite) {
    SKIP_WITHOUT_DEVICE();
    this->expect_refused(this->core_->SetInstance(0, 0, CoreTransform()));
    this->send(ContractScene());
    CoreTransform transform;
    transform.rows[1].z = std::numeric_limits<float>::quiet_NaN();
    this->expect_refused(this->core_->SetInstance(0, 0, transform));
    transform.rows[1].z = std::numeric_limits<float>::infinity();
    this->expect_refused(this->core_->SetInstance(0, 0, transform));
}

TYPED_TEST_P(CoreContractSuite, RefusesWhatRaysCannotReachOrStartFrom) {
    SKIP_WITHOUT_DEVICE();
    const float infinite = std::numeric_limits<float>::infinity(), none = std::numeric_limits<float>::quiet_NaN();
    this->send(ContractScene());
    this->expect_ok(this->core_->SetTarget(this->target()));
    const std::vector<glm::vec4> before = this->render();
    for (const float eye : {none, infinite, 2e18f, -1.1e12f}) {
        ViewPyramid view = contract_view();
        view.eye.x = eye;
        this->expect_refused(this->core_->Render(view, Convergence::Restart, 1));
        view = contract_view();
        view.top_left.y = eye * 1e7f;
        this->expect_refused(this->core_->Render(view, Convergence::Restart, 1));
    }
    ViewPyramid nothing;
    nothing.top_left = nothing.top_right = nothing.bottom_left = nothing.eye;
    this->expect_refused(this->core_->Render(nothing, Convergence::Restart, 1));
    ContractScene scene;
    scene.positions[2].x = none;
    this->expect_refused(this->core_->SetGeometry(0, scene.mesh()));
    scene = ContractScene();
    scene.normals[0].z = infinite;
    this->expect_refused(this->core_->SetGeometry(0, scene.mesh()));
    const std::vector<glm::vec2> coordinates(scene.positions.size(), glm::vec2(1.0f, -1.1e8f));
    CoreMesh mesh = scene.mesh();
    mesh.uv1 = coordinates;
    this->expect_refused(this->core_->SetGeometry(0, mesh));
    CoreMaterial material;
    material.emission.y = 1.1e12f;
    this->expect_refused(this->core_->SetMaterials(0, {&material, 1}));
    material = CoreMaterial();
    material.roughness = none;
    this->expect_refused(this->core_->SetMaterials(0, {&material, 1}));
    material = CoreMaterial();
    material.base_color_texture.texture = 0;
    material.base_color_texture.row_v.z = infinite;
    this->expect_refused(this->core_->SetMaterials(0, {&material, 1}));
    material = CoreMaterial();
    material.transmission = 1.0f;
    material.ior = 0.0f;
    this->expect_ok(this->core_->SetMaterials(0, {&material, 1}));
    material.thin_walled = false;
    this->expect_refused(this->core_->SetMaterials(0, {&material, 1}));
    this->expect_ok(this->core_->SetMaterials(0, scene.materials));
    scene = ContractScene();
    scene.lights[0].vertices[0].x = 2e18f;
    this->expect_refused(this->core_->SetLights(scene.light_table()));
    CoreTransform flat;
    flat.rows[1] = glm::vec4(0.0f);
    if (this->core_->SetInstance(0, 0, flat).ok()) this->render();  // a core may do without the inverse
    CoreTransform far;
    far.rows[0].w = 2e18f;
    this->expect_ok(this->core_->SetInstance(0, 0, far));
    this->expect_refused(this->core_->Render(contract_view(), Convergence::Restart, 1));
    CoreTransform tiny;  // from the eye, 3e18 in the mesh's own space
    tiny.rows[0].x = 1e-18f;
    this->expect_ok(this->core_->SetInstance(0, 0, tiny));
    this->expect_refused(this->core_->Render(contract_view(), Convergence::Restart, 1));
    this->expect_ok(this->core_->SetInstance(0, 0, CoreTransform()));
    EXPECT_EQ(this->render(), before);
}

TYPED_TEST_P(CoreContractSuite, RefusesTablesOfTheWrongLength) {
    SKIP_WITHOUT_DEVICE();
    const ContractScene scene;
    CoreLights lights = scene.light_table();
    lights.table = {};
    this->expect_refused(this->core_->SetLights(lights));
    const std::vector<AliasEntry> wild = {{0.5f, 7, 1.0f}};
    lights.table = wild;
    this->expect_refused(this->core_->SetLights(lights));
    const std::vector<glm::vec4> texels(2, glm::vec4(1));
    CoreSky sky;
    sky.width = 2;
    sky.height = 1;
    sky.texels = texels;
    this->expect_refused(this->core_->SetSkyData(sky));
    const std::vector<AliasEntry> table = {{1.0f, 0, 0.5f}, {1.0f, 1, 0.5f}};
    sky.table = table;
    this->expect_ok(this->core_->SetSkyData(sky));
    sky.width = 3;
    this->expect_refused(this->core_->SetSkyData(sky));
}

TYPED_TEST_P(CoreContractSuite, DanglingIdsAreRefusedAtRender) {
    SKIP_WITHOUT_DEVICE();
    this->expect_ok(this->core_->SetTarget(this->target()));
    ContractScene scene;
    scene.triangles[1].w = 1;  // no such material yet
    this->send(scene);
    this->expect_refused(this->core_->Render(contract_view(), Convergence::Restart, 1));
    this->expect_ok(this->core_->SetMaterials(1, scene.materials));
    this->render();
    scene.materials[0].emission_texture.texture = 1;  // no such texture
    this->expect_ok(this->core_->SetMaterials(1, scene.materials));
    this->expect_refused(this->core_->Render(contract_view(), Convergence::Restart, 1));
    this->expect_ok(this->core_->SetMaterials(1, ContractScene().materials));
    this->render();
    this->expect_ok(this->core_->SetTextures({}));
    this->expect_refused(this->core_->Render(contract_view(), Convergence::Restart, 1));
}

TYPED_TEST_P(CoreContractSuite, AFailedCallLeavesWhatWasSetBefore) {
    SKIP_WITHOUT_DEVICE();
    const ContractScene scene;
    this->send(scene);
    this->expect_ok(this->core_->SetTarget(this->target()));
    const std::vector<glm::vec4> before = this->render();
    ContractScene broken;
    broken.triangles[0].x = 99;
    this->expect_refused(this->core_->SetGeometry(0, broken.mesh()));
    this->expect_refused(this->core_->SetMaterials(9, broken.materials));
    this->expect_refused(this->core_->SetInstance(0, 5, CoreTransform()));
    CoreTexture texture = broken.texture();
    texture.levels = 9;
    this->expect_refused(this->core_->SetTextures({&texture, 1}));
    CoreTarget target{this->SIDE, 0, {}};
    this->expect_refused(this->core_->SetTarget(target));
    EXPECT_EQ(this->render(), before);
}

TYPED_TEST_P(CoreContractSuite, EditsTakeEffectWithTheNextRender) {
    SKIP_WITHOUT_DEVICE();
    const ContractScene scene;
    this->send(scene);
    this->expect_ok(this->core_->SetTarget(this->target()));
    const std::vector<glm::vec4> before = this->render();
    this->expect_ok(this->core_->SetInstance(0, NONE, CoreTransform()));
    this->render();
    EXPECT_EQ(this->core_->GetCoreStats().triangles, 0u);
    ContractScene half;
    half.triangles.pop_back();
    this->expect_ok(this->core_->SetGeometry(0, half.mesh()));
    this->expect_ok(this->core_->SetInstance(0, 0, CoreTransform()));
    this->render();
    EXPECT_EQ(this->core_->GetCoreStats().triangles, 1u);
    this->expect_ok(this->core_->SetGeometry(0, scene.mesh()));
    EXPECT_EQ(this->render(), before);
}

TYPED_TEST_P(CoreContractSuite, AMeshMayBeEmptyAtFirstAndInBetween) {
    SKIP_WITHOUT_DEVICE();
    const ContractScene scene;
    this->send(scene);
    this->expect_ok(this->core_->SetTarget(this->target()));
    const std::vector<glm::vec4> before = this->render();
    this->expect_ok(this->core_->SetGeometry(1, {}));
    EXPECT_EQ(this->render(), before);
    this->expect_ok(this->core_->SetInstance(0, 1, CoreTransform()));
    this->render();
    EXPECT_EQ(this->core_->GetCoreStats().triangles, 0u);
    for (const CoreMesh& mesh : {scene.mesh(), CoreMesh(), CoreMesh(), scene.mesh()}) {
        this->expect_ok(this->core_->SetGeometry(1, mesh));
        this->render();
        EXPECT_EQ(this->core_->GetCoreStats().triangles, mesh.triangles.size());
    }
    EXPECT_EQ(this->render(), before);
}

/// A scene that is edited at random, and can be handed to a core as a whole.
class EditedScene {
public:
    explicit EditedScene(uint32_t seed) : random_(seed) {
        for (int i = 0; i < 3; ++i) meshes_.push_back(sheet(2 + i));
        for (uint32_t i = 0; i < 6; ++i) instances_.push_back({i % 4 % 3, place()});  // mesh 2 has one, others more
        materials_.resize(2);
        materials_[0].base_color_texture.texture = 0;
        paint();
        shine();
    }

    Status send(CoreAPI& core) {
        Status status = set_textures(core);
        if (status.ok()) status = core.SetMaterials(0, materials_);
        for (uint32_t i = 0; i < meshes_.size() && status.ok(); ++i) status = core.SetGeometry(i, meshes_[i].mesh());
        for (uint32_t i = 0; i < instances_.size() && status.ok(); ++i)
            status = core.SetInstance(i, instances_[i].mesh, instances_[i].transform);
        if (status.ok()) status = set_lights(core);
        return status.ok() ? core.Setting({.max_path_length = 3}) : status;
    }

    /// One edit, most often a move or a deformation.
    Status edit(CoreAPI& core) {
        const uint32_t kind = below(18);
        const uint32_t mesh = below(3), instance = below(static_cast<uint32_t>(instances_.size()));
        if (kind < 4) {
            for (glm::vec3& p : meshes_[mesh].positions) p += 0.1f * glm::vec3(unit(), unit(), unit());
            return core.SetGeometry(mesh, meshes_[mesh].mesh());
        }
        if (kind == 4) {
            meshes_[mesh] = below(3) == 0 ? nothing() : sheet(1 + static_cast<int>(below(5)));
            return core.SetGeometry(mesh, meshes_[mesh].mesh());
        }
        if (kind < 7) {
            const uint32_t id = below(2);
            materials_[id].base_color = {0.5f, 0.9f * below(2), 0.25f};
            materials_[id].opaque = below(4) > 0;
            materials_[id].alpha = 0.5f;
            if (id == 0) materials_[0].base_color_texture.texture = below(2);
            return core.SetMaterials(id, {&materials_[id], 1});
        }
        if (kind == 7) {
            materials_.emplace_back();
            return core.SetMaterials(static_cast<uint32_t>(materials_.size() - 1), {&materials_.back(), 1});
        }
        if (kind == 8) {
            paint();
            return set_textures(core);
        }
        if (kind == 9) {
            shine();
            return set_lights(core);
        }
        Instance& placed = instances_[instance];
        if (kind == 10) placed.mesh = placed.mesh == NONE ? mesh : NONE;
        if (kind == 11) placed.mesh = mesh;
        placed.transform = place();
        return core.SetInstance(instance, placed.mesh, placed.transform);
    }

private:
    struct Instance {
        uint32_t mesh = NONE;
        CoreTransform transform;
    };

    uint32_t below(uint32_t end) { return static_cast<uint32_t>(random_() % end); }
    float unit() { return static_cast<float>(below(2001)) * 1e-3f - 1.0f; }

    CoreTransform place() {
        CoreTransform transform;
        const float size = 0.4f + 0.2f * unit(), turn = unit();
        transform.rows[0] = {size * std::cos(turn), -size * std::sin(turn), 0.1f * unit(), unit()};
        transform.rows[1] = {size * std::sin(turn), size * std::cos(turn), 0.1f * unit(), unit()};
        transform.rows[2] = {0.1f * unit(), 0.0f, size, unit()};
        return transform;
    }

    // Two textures of other sizes, texels and ways to read them.
    void paint() {
        for (auto& texels : texels_) {
            texels.resize(size_t{1} << below(4));
            for (uint32_t& texel : texels) texel = static_cast<uint32_t>(random_());
        }
        wraps_ = below(3);
    }

    Status set_textures(CoreAPI& core) const {
        CoreTexture textures[2];
        for (size_t i = 0; i < 2; ++i) {
            textures[i].width = static_cast<uint32_t>(texels_[i].size());
            textures[i].height = textures[i].levels = 1;
            textures[i].wrap_s = static_cast<TextureWrap>(wraps_);
            textures[i].nearest = wraps_ == 1;
            textures[i].texels = texels_[i];
        }
        return core.SetTextures(textures);
    }

    // A sky of other texels and up to three lights beside it.
    void shine() {
        sky_.resize(size_t{2} << below(3));
        std::vector<double> brightness;
        for (glm::vec4& texel : sky_) {
            texel = {0.5f + 0.5f * unit(), 0.5f, 0.5f + 0.5f * unit(), 0.0f};
            brightness.push_back(texel.x + texel.y + texel.z);
        }
        sky_table_ = build_alias_table(brightness);
        lights_.assign(1 + below(4), CoreLight());
        for (CoreLight& light : lights_) {
            light.kind = below(2) == 0 ? LightKind::point : LightKind::directional;
            light.vertices[0] = {unit(), unit(), 2.0f};
            light.emission = glm::vec3(2.0f + unit());
        }
        lights_[0].kind = LightKind::sky;
        light_table_ = build_alias_table(std::vector<double>(lights_.size(), 1.0));
    }

    Status set_lights(CoreAPI& core) const {
        CoreSky sky;
        sky.width = static_cast<uint32_t>(sky_.size());
        sky.height = 1;
        sky.texels = sky_;
        sky.table = sky_table_;
        sky.light_probability = 1.0f / static_cast<float>(lights_.size());
        const Status status = core.SetSkyData(sky);
        return status.ok() ? core.SetLights({lights_, light_table_, static_cast<float>(lights_.size())}) : status;
    }

    static ContractScene nothing() {
        ContractScene scene;
        scene.positions = scene.normals = {};
        scene.uv0 = {};
        scene.triangles = {};
        return scene;
    }

    // `side` x `side` squares, uneven, with both materials.
    ContractScene sheet(int side) {
        ContractScene scene;
        scene.positions.clear();
        scene.triangles.clear();
        for (int y = 0; y <= side; ++y) {
            for (int x = 0; x <= side; ++x)
                scene.positions.push_back({2.0f * static_cast<float>(x) / static_cast<float>(side) - 1.0f,
                                           2.0f * static_cast<float>(y) / static_cast<float>(side) - 1.0f,
                                           0.3f * unit()});
        }
        const auto vertex = [side](int x, int y) { return static_cast<uint32_t>(y * (side + 1) + x); };
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                scene.triangles.push_back({vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), below(2)});
                scene.triangles.push_back({vertex(x, y), vertex(x + 1, y + 1), vertex(x, y + 1), below(2)});
            }
        }
        scene.normals.assign(scene.positions.size(), glm::vec3(0, 0, 1));
        scene.uv0.clear();
        for (const glm::vec3& p : scene.positions) scene.uv0.push_back({p.x, p.y});
        return scene;
    }

    std::mt19937 random_;
    std::vector<ContractScene> meshes_;
    std::vector<Instance> instances_;
    std::vector<CoreMaterial> materials_;
    std::vector<uint32_t> texels_[2];
    uint32_t wraps_ = 0;
    std::vector<glm::vec4> sky_;
    std::vector<AliasEntry> sky_table_;
    std::vector<CoreLight> lights_;
    std::vector<AliasEntry> light_table_;
};

TYPED_TEST_P(CoreContractSuite, WhatIsRemovedGivesItsMemoryBack) {
    SKIP_WITHOUT_DEVICE();
    ContractScene scene;
    this->send(scene);
    this->expect_ok(this->core_->SetTarget(this->target()));
    const std::vector<glm::vec4> before = this->render();
    const uint64_t held = this->core_->GetCoreStats().memory_bytes;
    ContractScene large;
    large.triangles.clear();
    large.positions.clear();
    for (uint32_t i = 0; i < 50'000; ++i) {
        // Each behind the one before: triangles in one place are a matter of their own.
        const glm::vec3 corner(-0.5f, -0.5f, -1.0f - 0.01f * static_cast<float>(i));
        large.positions.insert(large.positions.end(),
                               {corner, corner + glm::vec3(1, 0, 0), corner + glm::vec3(0, 1, 0)});
        large.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2, 0});
    }
    large.normals.assign(large.positions.size(), glm::vec3(0, 0, 1));
    large.uv0.assign(large.positions.size(), glm::vec2(0));
    large.texels.assign(1 << 20, 0xFFFFFFFFu);
    CoreTexture textures[2] = {scene.texture(), large.texture()};
    textures[1].width = textures[1].height = 1024;
    textures[1].levels = 1;
    this->expect_ok(this->core_->SetGeometry(1, large.mesh()));
    this->expect_ok(this->core_->SetInstance(1, 1, CoreTransform()));
    this->expect_ok(this->core_->SetTextures(textures));
    this->render();
    const bool counts = held > 0;  // the null core holds nothing
    EXPECT_GE(this->core_->GetCoreStats().memory_bytes, held + (counts ? 6'000'000u : 0u));
    this->expect_ok(this->core_->SetInstance(1, NONE, CoreTransform()));
    this->expect_ok(this->core_->SetGeometry(1, CoreMesh()));
    this->expect_ok(this->core_->SetTextures({textures, 1}));
    EXPECT_EQ(this->render(), before);
    EXPECT_LE(this->core_->GetCoreStats().memory_bytes, held + (counts ? 100'000u : 0u));
    this->expect_ok(this->core_->SetInstance(1, 1, CoreTransform()));  // the id still stands for it
    EXPECT_EQ(this->render(), before);
}

// What would only be needed by later edits is given back, and nothing of that shows.
TYPED_TEST_P(CoreContractSuite, AStillCoreDrawsTheSameAndKeepsItsGeometry) {
    SKIP_WITHOUT_DEVICE();
    CoreTransform aside;
    aside.rows[0].w = 0.25f;
    const auto place = [&](const ContractScene& scene) {
        this->send(scene);
        this->expect_ok(this->core_->SetInstance(0, 0, aside));
        this->expect_ok(this->core_->SetTarget(this->target()));
    };
    ContractScene scene;
    place(scene);
    const std::vector<glm::vec4> expected = this->render();
    const uint64_t held = this->core_->GetCoreStats().memory_bytes;
    CoreOptions still = TypeParam::options();
    still.still = true;
    this->core_ = TypeParam::create();
    this->expect_ok(this->core_->Init(still));
    place(scene);
    EXPECT_EQ(this->render(), expected);
    EXPECT_LE(this->core_->GetCoreStats().memory_bytes, held);
    this->expect_refused(this->core_->SetGeometry(0, scene.mesh()), StatusCode::wrong_order);
    this->expect_refused(this->core_->SetInstance(0, 0, CoreTransform()), StatusCode::wrong_order);
    // All else may be edited, also what the geometry is placed by: whether rays may pass.
    scene.materials[0].opaque = false;
    scene.materials[0].alpha = 0.5f;
    this->expect_ok(this->core_->SetMaterials(0, scene.materials));
    const std::vector<glm::vec4> thin = this->render();
    this->core_ = TypeParam::create();
    this->expect_ok(this->core_->Init(TypeParam::options()));
    place(scene);
    EXPECT_EQ(this->render(), thin);
}

// A core that comes to a frame by itself draws it as one that has drawn those before it.
TYPED_TEST_P(CoreContractSuite, WhatIsSaidToMoveIsTheSameFromTheFirstPictureOn) {
    SKIP_WITHOUT_DEVICE();
    const auto turned = [](float angle) {
        CoreTransform out;
        out.rows[0] = {0.9f * std::cos(angle), -0.9f * std::sin(angle), 0.0f, 0.1f};
        out.rows[1] = {0.9f * std::sin(angle), 0.9f * std::cos(angle), 0.0f, -0.1f};
        return out;
    };
    const auto mesh_at = [](ContractScene& scene, float time, bool deforms) {
        for (size_t i = 0; i < 4; ++i)
            scene.positions[i].z = deforms ? 0.1f * std::sin(time + static_cast<float>(i)) : 0.0f;
        CoreMesh mesh = scene.mesh();
        mesh.moves = !deforms;
        mesh.deforms = deforms;
        return mesh;
    };
    constexpr float kFrames[] = {0.3f, 1.1f, 0.7f};
    for (const bool deforms : {false, true}) {
        const auto set_mesh = [&](float time) {
            ContractScene scene;
            this->expect_ok(this->core_->SetGeometry(0, mesh_at(scene, time, deforms)));
        };
        const auto show = [&](float time) {
            if (deforms) set_mesh(time);
            this->expect_ok(this->core_->SetInstance(0, 0, turned(deforms ? 0.5f : time)));
            return this->render(4);
        };
        const auto begin = [&](float time) {
            this->core_ = TypeParam::create();
            this->expect_ok(this->core_->Init(TypeParam::options()));
            this->send(ContractScene());
            set_mesh(time);
            this->expect_ok(this->core_->SetTarget(this->target()));
            return show(time);
        };
        std::vector<std::vector<glm::vec4>> alone, after;
        for (const float time : kFrames) alone.push_back(begin(time));
        for (const float time : kFrames) after.push_back(after.empty() ? begin(time) : show(time));
        EXPECT_EQ(alone, after) << (deforms ? "deformed" : "moved");
    }
}

// What moves is followed, and what stands still left alone: no such order of edits may be seen in the picture, four
// times on the way. The environment's EDITS asks for more or fewer of them.
TYPED_TEST_P(CoreContractSuite, AfterManyEditsThePictureIsThatOfTheSceneAsItIs) {
    SKIP_WITHOUT_DEVICE();
    const char* const wanted = std::getenv("EDITS");
    const int edits = wanted ? std::atoi(wanted) : TypeParam::EDITS;
    EditedScene scene(7);
    this->expect_ok(scene.send(*this->core_));
    this->expect_ok(this->core_->SetTarget(this->target()));
    this->render();
    for (int i = 1; i <= edits; ++i) {
        const Status status = scene.edit(*this->core_);
        ASSERT_TRUE(status.ok()) << "edit " << i << ": " << status.message;
        const bool is_compared = i % std::max(1, edits / 4) == 0;
        if (i % 3 != 0 && !is_compared) continue;
        const std::vector<glm::vec4> edited = this->render();
        if (!is_compared) continue;
        std::unique_ptr<CoreAPI> fresh = TypeParam::create();
        this->expect_ok(fresh->Init(TypeParam::options()));
        this->expect_ok(scene.send(*fresh));
        this->expect_ok(fresh->SetTarget(this->target()));
        std::swap(this->core_, fresh);
        ASSERT_EQ(this->render(), edited) << "after " << i << " edits";
        std::swap(this->core_, fresh);
        this->expect_ok(this->core_->SetTarget(this->target()));
    }
}

#undef SKIP_WITHOUT_DEVICE

REGISTER_TYPED_TEST_SUITE_P(
    CoreContractSuite, NothingWorksBeforeInitOrAfterShutdown, StatisticsAreZeroBeforeTheFirstRender, RendersAndCounts,
    ShowsEveryPathAfterEveryKernelAndRendersTheSame, ConvergeAddsAndRestartDrops, SamplesTakenInPartsGiveTheSamePicture,
    SumsOfPartsAreTheSumOfTheWhole, ARenderThatIsCalledOffDropsTheSamples, NoSamplesAreRefusedAndLeaveThePicture,
    ATargetOfAnotherSizeStartsAnew, AnEmptySceneIsAllSky, RefusesTargetsAndSettingsThatMakeNoSense,
    RefusesTexturesThatAreNoMipChain, RefusesGapsInNumberedThings, RefusesMeshesThatContradictThemselves,
    RefusesInstancesOfNothingAndMatricesThatAreNotFinite, RefusesWhatRaysCannotReachOrStartFrom,
    RefusesTablesOfTheWrongLength, DanglingIdsAreRefusedAtRender, AFailedCallLeavesWhatWasSetBefore,
    EditsTakeEffectWithTheNextRender, AMeshMayBeEmptyAtFirstAndInBetween, WhatIsRemovedGivesItsMemoryBack,
    AStillCoreDrawsTheSameAndKeepsItsGeometry, WhatIsSaidToMoveIsTheSameFromTheFirstPictureOn,
    AfterManyEditsThePictureIsThatOfTheSceneAsItIs);

}  // namespace render_system::testing
