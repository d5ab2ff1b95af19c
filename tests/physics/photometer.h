// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "render_system/render_system.h"

namespace physics {

/// A mean over independent seeds and its standard error, from the spread of the seeds' means.
struct Reading {
    double mean = 0.0;
    double error = 0.0;
};

/// How a reading is taken: a square picture of `size` pixels a side, all of it averaged over red, green and blue.
/// Of two with as many paths the larger picture is cheaper: each sample is a round of dispatches, whatever the size.
struct Exposure {
    uint32_t size = 16;
    uint32_t samples = 16;
    uint32_t max_path_length = 8;
    bool next_event_estimation = true;
    float indirect_limit = 0.0f;
};

/// Whether a core of that name ("source", "target") is built in and can open its device.
bool core_available(const std::string& core, std::string& reason);

/// Gives the cores back that the readings of a suite share.
void close_cores();

/// What happens to a scene after its first picture.
using SceneEdit = std::function<void(render_system::HostScene&)>;

/// Renders the scene with 16 seeds, roulette off, and averages; where there is an `edit`, after that.
Reading measure(const std::string& core, const render_system::HostScene& scene, const render_system::ViewPyramid& view,
                const Exposure& exposure, const SceneEdit& edit = {});

/// A view along `forward` from `eye` with that full vertical angle in radians, square.
render_system::ViewPyramid square_view(const glm::vec3& eye, const glm::vec3& target, float angle);

// Small meshes of one material.
render_system::HostMesh quad_mesh(const glm::vec3& corner, const glm::vec3& edge_u, const glm::vec3& edge_v,
                                  uint32_t material);
render_system::HostMesh sphere_mesh(float radius, uint32_t rings, uint32_t material);

/// Adds a mesh at the origin.
void place(render_system::HostScene& scene, render_system::HostMesh mesh);

/// Constant sky.
void set_sky(render_system::HostScene& scene, float radiance);

render_system::HostMaterial lambert(float albedo);
render_system::HostMaterial emitter(float radiance);

/// Runs over the cores that this build has; a core without a device is skipped with its reason.
class OnEveryCore : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        std::string reason;
        if (!core_available(GetParam(), reason)) {
            GTEST_SKIP() << reason;
        }
    }
    static void TearDownTestSuite() { close_cores(); }
};

}  // namespace physics
