// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The filters through the core's seam: they are given pictures of walls that no renderer made, of which it is known
// what must come out.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "target_core/render_core.h"

namespace filter_test {
namespace {

using namespace render_system;

constexpr uint32_t WIDTH = 128, HEIGHT = 96;
constexpr float HUGE_VARIANCE = 1.0e6f;

class Filter : public ::testing::Test {
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
// sum of squares of its weights: those of (1, 2, 1) / 4 at steps of 1, 2 and 4, one after another.
TEST_F(Filter, LeavesOfNoiseOnAWallWhatItsKernelImplies) {
    put_walls({0.5f, 0.5f}, {4.0f, 4.0f});
    std::vector<double> kernel = {1.0};
    for (const size_t step : {1, 2, 4}) {
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

// A large picture is filtered in bands, whose stages run behind each other. What of it is far enough from its ends, and
// from the crack between the walls that some rays pass through, is as in a part of it that is one band. Neither is a
// whole number of packets of lanes.
TEST_F(Filter, OfATallPictureIsThatOfItsParts) {
    put_walls({0.5f, 0.5f}, {4.0f, 4.0f});
    constexpr uint32_t ACROSS = 67, TALL = 301, PART = 59, SIDE = 12;
    std::mt19937 random(11);
    std::uniform_real_distribution<float> noise(0.5f, 1.5f);
    std::vector<float> gray(size_t{ACROSS} * TALL);
    for (float& value : gray) value = noise(random);
    pixels.resize(gray.size());
    expect_ok(core->SetTarget({ACROSS, TALL, pixels}));
    const std::vector<float> whole = filtered(gray, 0.02f);
    pixels.resize(size_t{ACROSS} * PART);
    expect_ok(core->SetTarget({ACROSS, PART, pixels}));
    for (uint32_t above = 0; above + PART <= TALL; above += PART - 2 * SIDE) {
        const auto first = gray.begin() + ACROSS * above;
        const std::vector<float> part = filtered({first, first + ACROSS * PART}, 0.02f);
        for (uint32_t row = SIDE; row < PART - SIDE; ++row)
            for (uint32_t column = 0; column < ACROSS / 2 - SIDE; ++column)
                ASSERT_NEAR(part[row * ACROSS + column], whole[(above + row) * ACROSS + column], 1e-3f)
                    << column << " " << above + row;
    }
}

// A pixel that is a hundred times as bright as all others is noise, but of what the picture has it is half.
TEST_F(Filter, SpreadsWhatIsTooBrightAndKeepsItsSum) {
    put_walls({0.5f, 0.5f}, {4.0f, 4.0f});
    std::vector<float> gray(size_t{WIDTH} * HEIGHT, 0.01f);
    gray[WIDTH * 48 + 96] = 120.0f;
    const std::vector<float> result = filtered(gray, HUGE_VARIANCE);
    double before = 0.0, after = 0.0;
    for (size_t i = 0; i < gray.size(); ++i) {
        before += gray[i];
        after += result[i];
        EXPECT_LT(result[i], 4.0f) << i % WIDTH << " " << i / WIDTH;
    }
    EXPECT_NEAR(after, before, 0.01 * before);
}

// Under a sky of radiance 1 a wall of albedo a is lit by that alone: what its guides bring is off the picture before
// the filter and back behind it, in pixels of one surface and of two.
TEST_F(Filter, PutsBackTheDirectLightThatItTakesOff) {
    put_walls({0.2f, 0.8f}, {4.0f, 3.0f});
    CoreSky sky;
    sky.radiance = glm::vec3(1.0f);
    expect_ok(core->SetSkyData(sky));
    std::vector<float> gray(size_t{WIDTH} * HEIGHT);
    for (size_t i = 0; i < gray.size(); ++i) gray[i] = i % WIDTH < WIDTH / 2 ? 0.5f : 1.5f;
    const std::vector<float> result = filtered(gray, HUGE_VARIANCE);
    double left = 0.0, right = 0.0;
    for (size_t i = 0; i < gray.size(); ++i) (i % WIDTH < WIDTH / 2 ? left : right) += result[i];
    EXPECT_NEAR(left / (WIDTH / 2 * HEIGHT), 0.5, 0.01);
    EXPECT_NEAR(right / (WIDTH / 2 * HEIGHT), 1.5, 0.01);
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

/// Frames, one after another, under a camera that stands or goes to the right by four pixels of the wall each time.
class TemporalFilter : public Filter {
protected:
    std::vector<float> next(const std::vector<float>& gray, float variance, uint32_t samples = 1) {
        std::vector<glm::vec4> means;
        for (const float value : gray) means.emplace_back(glm::vec3(value), 1.0f);
        const std::vector<float> variances(gray.size(), variance);
        const float x = moves ? 0.25f * static_cast<float>(frames) : 0.0f;
        const ViewPyramid view{{x, 0, 0}, {x - 1, 0.75f, -1}, {x + 1, 0.75f, -1}, {x - 1, -0.75f, -1}};
        expect_ok(core->Filter(view, {.means = means,
                                      .variances = variances,
                                      .first_sample = frames,
                                      .samples = samples,
                                      .filtered = means,
                                      .history = frames == 0 ? FilterHistory::begin : FilterHistory::go_on}));
        ++frames;
        std::vector<float> result;
        for (const glm::vec4& pixel : means) result.push_back(pixel.x);
        return result;
    }

    /// What is left in the middle of the picture of noise of that mean, the standard deviation of which is a third.
    double next_of_noise(double mean) {
        std::uniform_real_distribution<float> noise(static_cast<float>(0.42 * mean), static_cast<float>(1.58 * mean));
        std::vector<float> gray(size_t{WIDTH} * HEIGHT);
        for (float& value : gray) value = noise(random);
        const std::vector<float> result = next(gray, static_cast<float>(mean * mean / 9));
        double sum = 0.0;
        for (uint32_t y = 16; y < HEIGHT - 16; ++y)
            for (uint32_t x = 16; x < WIDTH - 16; ++x) sum += result[y * WIDTH + x];
        return sum / ((WIDTH - 32) * (HEIGHT - 32));
    }

    std::mt19937 random{3};
    bool moves = false;
    uint32_t frames = 0;
};

// A first frame has nothing to go by but itself: it is what the spatial filter makes of it, by way of other planes.
TEST_F(TemporalFilter, MakesOfAFirstFrameWhatTheSpatialFilterDoes) {
    put_walls({0.5f, 0.5f}, {4.0f, 4.0f});
    std::uniform_real_distribution<float> noise(0.5f, 1.5f);
    std::vector<float> gray(size_t{WIDTH} * HEIGHT);
    for (float& value : gray) value = noise(random);
    const std::vector<float> spatial = filtered(gray, 0.02f);
    const std::vector<float> first = next(gray, 0.02f, 4);
    for (size_t i = 0; i < gray.size(); ++i) ASSERT_NEAR(first[i], spatial[i], 1e-4f) << i % WIDTH << " " << i / WIDTH;
}

TEST_F(TemporalFilter, LeavesAStillPictureWithoutNoiseAsItIs) {
    put_walls({0.5f, 0.5f}, {4.0f, 4.0f});
    std::vector<float> gray(size_t{WIDTH} * HEIGHT), result;
    for (size_t i = 0; i < gray.size(); ++i) gray[i] = (i % WIDTH / 8 + i / WIDTH / 8) % 2 == 0 ? 0.2f : 0.8f;
    for (int pass = 0; pass < 5; ++pass) result = next(gray, 1.0e-8f);
    for (size_t i = 0; i < gray.size(); ++i) ASSERT_NEAR(result[i], gray[i], 2e-3f);
}

// Light is the plain mean of all passes; of these means the later ones count for more, by 2 / (n + 1).
TEST_F(TemporalFilter, TakesTheMeanOfThePassesOfAStillPicture) {
    put_walls({0.5f, 0.5f}, {4.0f, 4.0f});
    double sum = 0.0, shown = 0.0;
    for (int pass = 1; pass <= 9; ++pass) {
        const double value = 0.5 + 0.4 * std::sin(pass);
        sum += value;
        shown += (sum / pass - shown) * 2.0 / (pass + 1);
        const std::vector<float> result =
            next(std::vector<float>(size_t{WIDTH} * HEIGHT, static_cast<float>(value)), 0.1f);
        for (const float pixel : {result[0], result[WIDTH * 40 + 30], result.back()})
            ASSERT_NEAR(static_cast<double>(pixel), shown, 1e-4) << pass;
    }
}

// Nothing but the light itself tells. Four frames may show what was, the fifth may not.
TEST_F(TemporalFilter, ForgetsLightThatChangedWithinFourFrames) {
    put_walls({0.5f, 0.5f}, {4.0f, 4.0f});
    moves = true;
    for (const auto [before, after] : {std::array{1.0, 0.2}, {0.2, 1.0}, {1.0, 0.0}, {0.4, 0.8}}) {
        for (int frame = 0; frame < 8; ++frame) next_of_noise(before);
        double left = 0.0;
        for (int frame = 0; frame < 5; ++frame) left = next_of_noise(after);
        EXPECT_NEAR(left, after, 0.05 * std::abs(after - before)) << before << " became " << after;
    }
}

// The left wall is nearer: as the eye goes to the right, the wall uncovers a gap, and the gap what is behind it.
TEST_F(TemporalFilter, ShowsWhatWasHiddenWithoutATrail) {
    put_walls({0.5f, 0.5f}, {2.0f, 4.0f});
    moves = true;
    std::vector<float> gray(size_t{WIDTH} * HEIGHT), result;
    for (uint32_t frame = 0; frame < 6; ++frame) {
        // Both end at x = 0, seen from frame / 4 in a picture as wide as twice the distance.
        const size_t near_end = 64 - 8 * frame, far_end = 64 - 4 * frame;
        for (size_t i = 0; i < gray.size(); ++i)
            gray[i] = i % WIDTH < near_end ? 0.1f : i % WIDTH < far_end ? 0.0f : 0.9f;
        result = next(gray, 1.0e-4f);
        for (size_t i = 0; i < gray.size(); ++i) ASSERT_NEAR(result[i], gray[i], 2e-3f) << frame << ": " << i % WIDTH;
    }
}

// A sample of infinite radiance spoils its own pixel's mean, and that alone.
TEST_F(TemporalFilter, FillsPixelsWithoutAMeanFromThoseAround) {
    put_walls({0.5f, 0.5f}, {4.0f, 4.0f});
    std::vector<float> gray(size_t{WIDTH} * HEIGHT, 0.75f);
    gray[WIDTH * 20 + 30] = std::numeric_limits<float>::infinity();
    gray[WIDTH * 50 + 90] = std::numeric_limits<float>::quiet_NaN();
    for (const float value : filtered(gray, 0.1f)) ASSERT_NEAR(value, 0.75f, 1e-4f);
    for (int pass = 0; pass < 3; ++pass)
        for (const float value : next(gray, 0.1f)) ASSERT_NEAR(value, 0.75f, 1e-4f) << pass;
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
    EXPECT_EQ(core->Filter({}, {.means = means, .filtered = means, .most_rays = 0}).code, StatusCode::invalid_argument);
}

}  // namespace
}  // namespace filter_test
