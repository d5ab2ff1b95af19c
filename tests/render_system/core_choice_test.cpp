// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/core_choice.h"

#include <gmock/gmock.h>

#include "tests/render_system/counting_core.h"

namespace render_system::testing::core_choice_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

HostScene one_triangle_scene() {
    HostScene scene;
    scene.add_material(HostMaterial());
    HostMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, glm::vec3(0, 0, 1));
    mesh.triangles = {{0, 1, 2, 0}};
    scene.add_instance(scene.add_mesh(mesh), CoreTransform());
    return scene;
}

class CoreChoiceTest : public ::testing::Test {
protected:
    CoreChoiceTest() : system_(one_triangle_scene()) {
        registry_.add("source",
                      [this]() -> std::unique_ptr<CoreAPI> { return std::make_unique<CountingCore>(source_); });
        registry_.add("target",
                      [this]() -> std::unique_ptr<CoreAPI> { return std::make_unique<CountingCore>(target_); });
    }

    Result<CoreChoice> choose(const std::vector<std::string>& ids) {
        return choose_core(registry_, ids, CoreOptions(), system_, [this](RenderSystem& system) {
            const Status status = system.core().SetTarget({1, 1, pixel_});
            return status.ok() ? system.render(ViewPyramid(), Convergence::Restart, 1) : status;
        });
    }

    std::shared_ptr<CountingCore::Log> source_ = std::make_shared<CountingCore::Log>();
    std::shared_ptr<CountingCore::Log> target_ = std::make_shared<CountingCore::Log>();
    CoreRegistry registry_;
    RenderSystem system_;
    std::vector<glm::vec4> pixel_ = std::vector<glm::vec4>(1);
};

TEST_F(CoreChoiceTest, TakesTheFirstThatWorks) {
    source_->stats.memory_bytes = 3500000;
    source_->stats.memory_allowed_bytes = uint64_t{64} << 20;
    const Result<CoreChoice> choice = choose({"source", "target"});
    ASSERT_TRUE(choice.ok()) << choice.status.message;
    EXPECT_EQ(choice->core, "source");
    EXPECT_EQ(choice->reason, "core source: the scene fits, it needs 4 MiB, 64 MiB are allowed");
    EXPECT_TRUE(target_->calls.empty());
    EXPECT_EQ(source_->calls.back(), "Render");
}

TEST_F(CoreChoiceTest, PassesOverACoreWhoseMemoryTheSceneExceeds) {
    const Status full = Status::out_of_memory("too much", uint64_t{412} << 20, uint64_t{64} << 20);
    for (Status* place : {&source_->geometry_status, &source_->render_status}) {
        source_->geometry_status = source_->render_status = Status::success();
        *place = full;
        const Result<CoreChoice> choice = choose({"source", "target"});
        ASSERT_TRUE(choice.ok()) << choice.status.message;
        EXPECT_EQ(choice->core, "target");
        EXPECT_EQ(choice->reason, "core target: core source needs 412 MiB, 64 MiB are allowed");
        // The second core got the whole scene, not what the first had left over.
        EXPECT_THAT(target_->calls, ::testing::Contains("SetGeometry 0"));
        target_->calls.clear();
    }
}

TEST_F(CoreChoiceTest, PassesOverACoreWithoutADevice) {
    source_->init_status = Status::error(StatusCode::no_device, "no Vulkan driver");
    const Result<CoreChoice> choice = choose({"source", "target"});
    ASSERT_TRUE(choice.ok());
    EXPECT_EQ(choice->core, "target");
    EXPECT_EQ(choice->reason, "core target: core source: no Vulkan driver");
}

TEST_F(CoreChoiceTest, WithOneCoreItsFailureIsTheAnswer) {
    source_->geometry_status = Status::out_of_memory("too much", uint64_t{412} << 20, uint64_t{64} << 20);
    const Result<CoreChoice> choice = choose({"source"});
    ASSERT_FALSE(choice.ok());
    EXPECT_EQ(choice.status.code, StatusCode::out_of_memory);
    EXPECT_EQ(choice.status.message, "core source needs 412 MiB, 64 MiB are allowed");
}

TEST_F(CoreChoiceTest, NamesTheReasonsOfAllWhereNoneWorks) {
    source_->init_status = Status::error(StatusCode::no_device, "no Vulkan driver");
    target_->init_status = Status::error(StatusCode::no_device, "no processor");
    const Result<CoreChoice> choice = choose({"source", "target"});
    ASSERT_FALSE(choice.ok());
    EXPECT_EQ(choice.status.message, "core source: no Vulkan driver; core target: no processor");
}

TEST_F(CoreChoiceTest, ABugIsNotPassedOver) {
    source_->render_status = Status::error(StatusCode::internal, "kernel shade does not compile");
    const Result<CoreChoice> choice = choose({"source", "target"});
    ASSERT_FALSE(choice.ok());
    EXPECT_EQ(choice.status.code, StatusCode::internal);
    EXPECT_TRUE(target_->calls.empty());
}

TEST_F(CoreChoiceTest, AnUnknownCoreIsNamedWithTheKnownOnes) {
    EXPECT_EQ(choose({"sauce"}).status.message, "no core is called \"sauce\"; there is source, target");
    EXPECT_EQ(registry_.ids(), (std::vector<std::string>{"source", "target"}));
    EXPECT_FALSE(choose({}).ok());
}

}  // namespace
}  // namespace render_system::testing::core_choice_test
