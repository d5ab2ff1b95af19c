// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The spatial filter through the core's seam: it is given pictures of walls that no renderer made, of which it is known
// what must come out.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "target_core/render_core.h"

namespace filter_test {
namespace {

using namespace render_system;

constexpr uint32_t WIDTH = 128, HEIGHT = 96;
constexpr float HUGE_VARIANCE = 1.0e6f;

class Filter : public testing::Test {
protected:
    void SetUp() override {
        CoreOptions options;
        options.exact = exact;
        expect_ok(core->Init(options));
        expect_ok(core->SetTextures({}));
        expect_ok(core->SetLights({}));
        expect_ok(core->SetSkyData({}));
        expect_ok(core->SetTarget({WIDTH, HEIGHT, pixels}));
        expect_ok(core->Setting({}));
    }

    static void expect_ok(const Status& status) { ASSERT_TRUE(status.ok()) << status.message; }

    /// What the left and the right half of the picture show: quads that face +z, seen along -z from the origin, of an
    /// albedo each and that far off. Their common border is at x = 0.
    void put_walls(std::array<float, 2> albedos, std::array<float, 2> distances) {
        std::array<CoreMaterial, 2> materials;
        for (uint32_t side = 0; side < 2; ++side) {
            materials[side].base_color = glm::vec3(albedos[side]);
            materials[side].metallic = 0.0f;
            materials[side].specular = 0.0f;
        }
        expect_ok(core->SetMaterials(0, materials));
        for (uint32_t side = 0; side < 2; ++side) {
            const float z = -distances[side], far = side == 0 ? -50.0f : 50.0f;
            const std::vector<glm::vec3> corners = {{0, -50, z}, {far, -50, z}, {far, 50, z}, {0, 50, z}};
            const std::vector<glm::vec3> normals(4, glm::vec3(0, 0, 1));
            const std::vector<glm::uvec4> triangles = {{0, 1, 2, side}, {0, 2, 3, side}};
            CoreMesh mesh;
            mesh.positions = corners;
            mesh.normals = normals;
            mesh.triangles = triangles;
            expect_ok(core->SetGeometry(side, mesh));
            expect_ok(core->SetInstance(side, side, {}));
        }
    }

    std::vector<float> filtered(const std::vector<float>& gray, float variance) {
        std::vector<glm::vec4> means;
        for (const float value : gray) means.emplace_back(glm::vec3(value), 1.0f);
        const std::vector<float> variances(gray.size(), variance);
        ViewPyramid view;
        view.eye = {0, 0, 0};
        view.top_left = {-1, 0.75f, -1};
        view.top_right = {1, 0.75f, -1};
        view.bottom_left = {-1, -0.75f, -1};
        expect_ok(core->Filter(view, {.means = means, .variances = variances, .samples = 4, .filtered = means}));
        std::vector<float> result;
        for (const glm::vec4& pixel : means) result.push_back(pixel.x);
        return result;
    }

    bool exact = false;
    std::vector<glm::vec4> pixels = std::vector<glm::vec4>(size_t{WIDTH} * HEIGHT);
    std::unique_ptr<CoreAPI> core = target_core::create_core();
};

TEST_F(Filter, LeavesAConstantPictureAsItIs) {
    put_walls({0.5f, 0.5f}, {4.0f, 4.0f});
    for (const float value : filtered(std::vector<float>(size_t{WIDTH} * HEIGHT, 0.75f), HUGE_VARIANCE))
        ASSERT_NEAR(value, 0.75f, 1e-5f);
}

// With variances that make any difference likely the filter is linear on one wall. What it then leaves of noise is the
// sum of squares of its weights: those of (1, 2, 1) / 4 at steps of 1, 2, 4, 8 and 16, one after another.
TEST_F(Filter, LeavesOfNoiseOnAWallWhatItsKernelImplies) {
    put_walls({0.5f, 0.5f}, {4.0f, 4.0f});
    std::vector<double> kernel = {1.0};
    for (const size_t step : {1, 2, 4, 8, 16}) {
        std::vector<double> wider(kernel.size() + 2 * step, 0.0);
        for (size_t i = 0; i < kernel.size(); ++i) {
            wider[i] += 0.25 * kernel[i];
            wider[i + step] += 0.5 * kernel[i];
            wider[i + 2 * step] += 0.25 * kernel[i];
        }
        kernel = std::move(wider);
    }
    double along = 0.0;
    for (const double weight : kernel) along += weight * weight;
    const double expected = along * along;  // in both directions

    std::mt19937 random(7);
    std::uniform_real_distribution<float> noise(-0.5f, 0.5f);
    double left = 0.0, mean = 0.0;
    int count = 0;
    for (int picture = 0; picture < 24; ++picture) {
        std::vector<float> gray(size_t{WIDTH} * HEIGHT);
        for (float& value : gray) value = 1.0f + noise(random);
        const std::vector<float> result = filtered(gray, HUGE_VARIANCE);
        for (uint32_t y = 34; y < HEIGHT - 34; ++y) {
            for (uint32_t x = 34; x < WIDTH - 34; ++x, ++count) {
                const double off = result[y * WIDTH + x] - 1.0;
                left += off * off;
                mean += off;
            }
        }
    }
    const double factor = left / count * 12.0;  // uniform noise of width 1 has a variance of 1/12
    EXPECT_NEAR(mean / count, 0.0, 0.004);
    EXPECT_LT(factor, 1.6 * expected);
    EXPECT_GT(factor, 0.5 * expected);
}

TEST_F(Filter, DoesNotBlurAcrossAnEdgeInDepth) {
    put_walls({0.5f, 0.5f}, {4.0f, 3.0f});
    std::vector<float> gray(size_t{WIDTH} * HEIGHT);
    for (size_t i = 0; i < gray.size(); ++i) gray[i] = i % WIDTH < WIDTH / 2 ? 0.2f : 0.8f;
    const std::vector<float> result = filtered(gray, HUGE_VARIANCE);
    for (size_t i = 0; i < gray.size(); ++i) ASSERT_NEAR(result[i], gray[i], 1e-4f) << i % WIDTH << " " << i / WIDTH;
}

TEST_F(Filter, KeepsAnEdgeInAlbedo) {
    put_walls({0.1f, 0.8f}, {4.0f, 4.0f});
    std::vector<float> gray(size_t{WIDTH} * HEIGHT);
    // The same light on both: radiance goes by albedo, which the filter takes to be 0.01 more.
    for (size_t i = 0; i < gray.size(); ++i) gray[i] = i % WIDTH < WIDTH / 2 ? 0.11f : 0.81f;
    const std::vector<float> result = filtered(gray, HUGE_VARIANCE);
    for (size_t i = 0; i < gray.size(); ++i) ASSERT_NEAR(result[i], gray[i], 1e-4f) << i % WIDTH << " " << i / WIDTH;
}

// Where the samples are sure of what they see, the filter has nothing to say.
TEST_F(Filter, LeavesWhatIsNotNoise) {
    put_walls({0.5f, 0.5f}, {4.0f, 4.0f});
    std::vector<float> gray(size_t{WIDTH} * HEIGHT);
    for (size_t i = 0; i < gray.size(); ++i) gray[i] = (i % WIDTH / 8 + i / WIDTH / 8) % 2 == 0 ? 0.2f : 0.8f;
    const std::vector<float> result = filtered(gray, 1.0e-8f);
    for (size_t i = 0; i < gray.size(); ++i) ASSERT_NEAR(result[i], gray[i], 2e-3f);
}

TEST_F(Filter, RefusesSpansOfAnotherSize) {
    put_walls({0.5f, 0.5f}, {4.0f, 4.0f});
    std::vector<glm::vec4> means(size_t{WIDTH} * HEIGHT), fewer(WIDTH);
    const std::vector<float> variances(WIDTH);
    EXPECT_EQ(core->Filter({}, {.means = fewer, .filtered = means}).code, StatusCode::invalid_argument);
    EXPECT_EQ(core->Filter({}, {.means = means, .filtered = fewer}).code, StatusCode::invalid_argument);
    EXPECT_EQ(core->Filter({}, {.means = means, .variances = variances, .filtered = means}).code,
              StatusCode::invalid_argument);
    EXPECT_EQ(core->Filter({}, {.means = means, .samples = 0, .filtered = means}).code, StatusCode::invalid_argument);
}

}  // namespace
}  // namespace filter_test
