// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/checked_core.h"

#include <gtest/gtest.h>

#include <new>

namespace render_system::testing::checked_core_test {
namespace {

// Counts what reaches the work, and runs out of memory when told to.
class FullCore final : public CheckedCore {
public:
    explicit FullCore(InstanceMatrices matrices = InstanceMatrices::any) : CheckedCore("full", matrices) {}

    int calls = 0;
    bool full = false;

private:
    void work() {
        if (full) throw std::bad_alloc();
        ++calls;
    }
    Status work_with_status() {
        work();
        return Status::success();
    }
    Result<std::string> open() override {
        work();
        return std::string("a device");
    }
    void resize(uint32_t, uint32_t) override { work(); }
    void set_textures(std::span<const CoreTexture>) override { work(); }
    void set_materials(uint32_t, std::span<const CoreMaterial>) override { work(); }
    void set_lights(const CoreLights&) override { work(); }
    void set_sky(const CoreSky&) override { work(); }
    void set_mesh(uint32_t, const CoreMesh&) override { work(); }
    void set_instance(uint32_t, uint32_t, const CoreTransform&) override { work(); }
    Status prepare() override { return work_with_status(); }
    Status render(const ViewPyramid&, uint32_t, CallOff&) override { return work_with_status(); }
    Status filter(const ViewPyramid&, const CoreFilter&, CallOff&) override { return Status::success(); }
    void close() override {}
    uint64_t host_bytes() const override { return 123; }
};

CoreTransform flat() {
    CoreTransform transform;
    transform.rows[2] = {};
    return transform;
}

void expect_full(const Status& status) {
    EXPECT_EQ(status.code, StatusCode::out_of_memory);
    EXPECT_EQ(status.message, "full core: the machine's memory is used up");
    EXPECT_EQ(status.needed_bytes, 123u);
}

TEST(CheckedCore, AnExhaustedMemoryLeavesWhatWasSetBefore) {
    FullCore core;
    core.full = true;
    expect_full(core.Init({}));
    core.full = false;
    ASSERT_TRUE(core.Init({}).ok());
    const CoreMaterial material;
    core.full = true;
    expect_full(core.SetMaterials(0, {&material, 1}));
    expect_full(core.SetTextures({}));
    expect_full(core.SetLights({}));
    expect_full(core.SetSkyData({}));
    expect_full(core.SetGeometry(0, {}));
    core.full = false;
    EXPECT_EQ(core.SetMaterials(1, {&material, 1}).code, StatusCode::invalid_argument) << "a gap: there is none yet";
    EXPECT_EQ(core.SetInstance(0, 0, {}).code, StatusCode::invalid_argument) << "there is no mesh yet";
    std::vector<glm::vec4> pixels(4);
    core.full = true;
    expect_full(core.SetTarget({2, 2, pixels}));
    core.full = false;
    EXPECT_EQ(core.Render({}, Convergence::Restart, 1).code, StatusCode::wrong_order) << "there is no target yet";
    ASSERT_TRUE(core.SetTarget({2, 2, pixels}).ok());
    ASSERT_TRUE(core.Render({}, Convergence::Restart, 2).ok());
    core.full = true;
    expect_full(core.Render({}, Convergence::Converge, 1));
    EXPECT_EQ(core.GetCoreStats().samples, 2u);
}

TEST(CheckedCore, WhatIsRefusedDoesNotReachTheWork) {
    FullCore core;
    ASSERT_TRUE(core.Init({}).ok());
    EXPECT_EQ(core.calls, 1);
    EXPECT_FALSE(core.Init({}).ok());
    EXPECT_FALSE(core.SetTarget({}).ok());
    EXPECT_FALSE(core.SetMaterials(1, {}).ok());
    EXPECT_FALSE(core.SetInstance(0, 0, {}).ok());
    EXPECT_FALSE(core.Render({}, Convergence::Restart, 1).ok());
    core.Shutdown();
    EXPECT_FALSE(core.SetLights({}).ok());
    EXPECT_EQ(core.calls, 1);
}

TEST(CheckedCore, FlatInstancesAreRefusedWhereTheCoreNeedsTheInverse) {
    FullCore any, inverting(InstanceMatrices::invertible);
    for (FullCore* core : {&any, &inverting}) {
        ASSERT_TRUE(core->Init({}).ok());
        ASSERT_TRUE(core->SetGeometry(0, {}).ok());
        EXPECT_TRUE(core->SetInstance(0, NONE, flat()).ok());
    }
    EXPECT_TRUE(any.SetInstance(0, 0, flat()).ok());
    EXPECT_EQ(inverting.SetInstance(0, 0, flat()).message, "instance: the matrix cannot be inverted");
    EXPECT_TRUE(inverting.SetInstance(0, 0, {}).ok());
}

TEST(CheckedCore, SaysTheNumberOfThreadsItself) {
    FullCore all, three;
    ASSERT_TRUE(all.Init({}).ok());
    ASSERT_TRUE(three.Init({.threads = 3}).ok());
    EXPECT_GE(all.GetCoreStats().threads, 1u);
    EXPECT_EQ(three.GetCoreStats().threads, 3u);
    EXPECT_EQ(three.GetCoreStats().core, "full");
    EXPECT_EQ(three.GetCoreStats().device, "a device");
}

}  // namespace
}  // namespace render_system::testing::checked_core_test
