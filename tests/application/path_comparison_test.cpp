// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
//
// Two paths through a made-up core of two pixels: what is changed on one side is what must be named.
#include "application/locate/path_comparison.h"

#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <limits>
#include <vector>

namespace path_comparison_test {
namespace {

using namespace application;
using render_system::HostScene;
using render_system::NONE;
using render_system::PathKernel;
using render_system::PathStates;

/// The rows of two paths. Both meet a surface, path 1 sends a shadow ray and goes on.
struct Wave {
    std::vector<float> origins = {0, 0, 4, 0, 0.5f, 0, 4, 0};
    std::vector<float> directions = {0, 0, -1, 0.1f, 0, 0, -1, 0.1f};
    std::vector<float> throughputs = {1, 1, 1, 0, 1, 1, 1, 0};
    std::vector<float> radiances = {0, 0, 0, 0, 0, 0, 0, 0};
    std::vector<uint32_t> queue = {0, 1};
    std::vector<uint32_t> surfaces = {0, 0, 0, 0, 1, 0, 0, 0};
    std::vector<uint32_t> next = {1};
    std::vector<float> shadow_origins = {0.5f, 0, 0, 2};
    std::vector<float> shadow_directions = {0, 1, 0, std::bit_cast<float>(1u)};
    std::vector<float> shadow_contributions = {3, 3, 3, 0};
    std::vector<float> means = {0, 0, 0, 1, 3, 3, 3, 1};

    PathStates states(PathKernel kernel) const {
        PathStates states;
        states.kernel = kernel;
        states.segment = kernel == PathKernel::generate ? 0 : 1;
        states.path_count = 2;
        states.origins = origins;
        states.directions = directions;
        states.throughputs = throughputs;
        states.radiances = radiances;
        states.queue = kernel == PathKernel::shade ? next : queue;
        states.surfaces = surfaces;
        states.shadow_origins = shadow_origins;
        states.shadow_directions = shadow_directions;
        states.shadow_contributions = shadow_contributions;
        states.means = means;
        return states;
    }
};

constexpr PathKernel KERNELS[] = {PathKernel::generate, PathKernel::extend, PathKernel::shade, PathKernel::connect,
                                  PathKernel::finalize};

/// Two triangles at z = 0 that cover one another, and one at z = -1, all of material 0 and larger than the view.
HostScene overlapping_triangles() {
    HostScene scene;
    scene.add_material({"paint", {}});
    render_system::HostMesh mesh;
    for (const float z : {0.0f, 0.0f, -1.0f})
        for (const glm::vec2 corner : {glm::vec2(-9, -9), glm::vec2(9, -9), glm::vec2(0, 9)})
            mesh.positions.emplace_back(corner, z);
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0, 1));
    mesh.triangles = {{0, 1, 2, 0}, {3, 4, 5, 0}, {6, 7, 8, 0}};
    scene.add_instance(scene.add_mesh(mesh), {});
    return scene;
}

/// What is found where `change` was made to the second core's rows before it shows them after `kernel`.
PathDifferences differences_with(PathKernel kernel, const std::function<void(Wave&)>& change, float tolerance = 0.0f) {
    const HostScene scene = overlapping_triangles();
    PathLog log(2);
    PathComparison comparison(log, scene, 2, {tolerance});
    Wave first, second;
    for (const PathKernel now : KERNELS) log.after(first.states(now));
    for (const PathKernel now : KERNELS) {
        if (now == kernel) change(second);
        comparison.after(second.states(now));
    }
    comparison.finish_sample();
    return comparison.differences();
}

void expect_one(const PathDifferences& found, PathKernel kernel, PathField field, uint32_t pixel) {
    ASSERT_EQ(found.kernels.size(), 1u);
    EXPECT_EQ(found.kernels[0].kernel, kernel);
    EXPECT_STREQ(field_name(found.kernels[0].field()), field_name(field));
    EXPECT_EQ(found.kernels[0].pixel, pixel);
    EXPECT_EQ(found.kernels[0].paths, 1u);
    EXPECT_EQ(found.paths, 2u);
    EXPECT_EQ(found.explained_by_ties, 0u);
}

TEST(PathComparison, FindsNothingWhereNothingDiffers) {
    const PathDifferences found = differences_with(PathKernel::generate, [](Wave&) {});
    EXPECT_TRUE(found.kernels.empty());
    EXPECT_EQ(found.parted_in, (std::vector<uint8_t>{0, 0}));
}

TEST(PathComparison, NamesKernelFieldAndPixel) {
    const auto expect = [](PathKernel kernel, PathField field, uint32_t pixel,
                           const std::function<void(Wave&)>& change) {
        SCOPED_TRACE(std::string(kernel_name(kernel)) + " " + field_name(field));
        expect_one(differences_with(kernel, change), kernel, field, pixel);
    };
    expect(PathKernel::generate, PathField::ray_direction, 0, [](Wave& w) { w.directions[1] = 0.25f; });
    expect(PathKernel::generate, PathField::cone_growth, 1, [](Wave& w) { w.directions[7] = 0.2f; });
    expect(PathKernel::extend, PathField::hit, 1, [](Wave& w) { w.surfaces[6] = 2; });
    expect(PathKernel::extend, PathField::hit, 1, [](Wave& w) { w.surfaces.resize(4); });
    expect(PathKernel::extend, PathField::radiance, 0, [](Wave& w) { w.radiances[2] = 1; });
    expect(PathKernel::shade, PathField::shadow_contribution, 1, [](Wave& w) { w.shadow_contributions[0] = 2; });
    expect(PathKernel::shade, PathField::shadow_distance, 1, [](Wave& w) { w.shadow_origins[3] = 1; });
    expect(PathKernel::shade, PathField::continues, 0, [](Wave& w) { w.next = {1, 0}; });
    expect(PathKernel::shade, PathField::pdf, 1, [](Wave& w) { w.throughputs[7] = 0.5f; });
    expect(PathKernel::connect, PathField::radiance, 1, [](Wave& w) { w.radiances[4] = 3; });
    expect(PathKernel::finalize, PathField::pixel, 0, [](Wave& w) { w.means[0] = 1e-30f; });
}

TEST(PathComparison, InfinityIsNoCloserToANumberThanAnyOther) {
    const auto overflow = [](Wave& w) { w.shadow_contributions[0] = std::numeric_limits<float>::infinity(); };
    expect_one(differences_with(PathKernel::shade, overflow, NATIVE_TOLERANCE), PathKernel::shade,
               PathField::shadow_contribution, 1);
    const auto no_number = [](Wave& w) { w.shadow_contributions[0] = std::numeric_limits<float>::quiet_NaN(); };
    expect_one(differences_with(PathKernel::shade, no_number, NATIVE_TOLERANCE), PathKernel::shade,
               PathField::shadow_contribution, 1);
}

TEST(PathComparison, LeavesAsideWhatNoLaterKernelReads) {
    // Path 0 ends in shade: nobody looks at its ray again.
    EXPECT_TRUE(differences_with(PathKernel::shade, [](Wave& w) { w.directions[0] = 1; }).kernels.empty());
    // The order of a queue is chance on the device.
    EXPECT_TRUE(differences_with(PathKernel::extend, [](Wave& w) {
                    w.queue = {1, 0};
                    w.surfaces = {1, 0, 0, 0, 0, 0, 0, 0};
                }).kernels.empty());
}

TEST(PathComparison, SaysWhatThePathsWereOn) {
    const auto found = differences_with(PathKernel::shade, [](Wave& w) { w.shadow_contributions[0] = 2; });
    EXPECT_EQ(found.kernels.at(0).materials, (std::map<uint32_t, uint64_t>{{0, 1}}));
    EXPECT_EQ(found.kernels.at(0).instances, (std::map<uint32_t, uint64_t>{{0, 1}}));
}

TEST(PathComparison, CountsOtherTrianglesAtTheSameDistanceAsTies) {
    const auto tie = [](Wave& w) { w.surfaces[6] = 1; };
    const PathDifferences native = differences_with(PathKernel::extend, tie, NATIVE_TOLERANCE);
    EXPECT_TRUE(native.kernels.empty());
    EXPECT_EQ(native.explained_by_ties, 1u);
    EXPECT_EQ(native.parted_in[1], PathDifferences::TIE);
    expect_one(differences_with(PathKernel::extend, tie), PathKernel::extend, PathField::hit, 1);
    const auto farther = [](Wave& w) { w.surfaces[6] = 2; };
    expect_one(differences_with(PathKernel::extend, farther, NATIVE_TOLERANCE), PathKernel::extend, PathField::hit, 1);
    const auto missed = [](Wave& w) { w.surfaces.resize(4); };
    expect_one(differences_with(PathKernel::extend, missed, NATIVE_TOLERANCE), PathKernel::extend, PathField::hit, 1);
}

TEST(PathComparison, AllowsForRoundingInNativeModeOnly) {
    const auto rounded = [](Wave& w) { w.shadow_contributions[1] = 3.001f; };
    EXPECT_TRUE(differences_with(PathKernel::shade, rounded, NATIVE_TOLERANCE).kernels.empty());
    EXPECT_EQ(differences_with(PathKernel::shade, rounded).kernels.size(), 1u);
    const auto wrong = [](Wave& w) { w.shadow_contributions[1] = 3.01f; };
    EXPECT_EQ(differences_with(PathKernel::shade, wrong, NATIVE_TOLERANCE).kernels.size(), 1u);
}

TEST(PathComparison, FollowsNoPathPastItsFirstDifference) {
    // What the wrong ray of path 1 leads to is not held against later kernels.
    const auto found = differences_with(PathKernel::generate, [](Wave& w) {
        w.directions[4] = 0.5f;
        w.surfaces[6] = 2;
        w.means[4] = 1;
    });
    expect_one(found, PathKernel::generate, PathField::ray_direction, 1);
}

TEST(PathComparison, TakesRowsOfABrokenKernelAsTheyCome) {
    const auto found = differences_with(PathKernel::extend, [](Wave& w) {
        w.surfaces = {7, 0, 0, 0, 0, 99, 99, 0};
        w.queue = {0, 0, 1000000, 1};
        w.shadow_directions[3] = std::bit_cast<float>(4000000000u);
    });
    ASSERT_EQ(found.kernels.size(), 1u);
    EXPECT_EQ(found.kernels[0].kernel, PathKernel::extend);
    EXPECT_EQ(found.kernels[0].paths, 2u);
}

}  // namespace
}  // namespace path_comparison_test
