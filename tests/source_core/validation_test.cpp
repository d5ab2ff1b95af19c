// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Renders under the validation layers: core checks, GPU-assisted checks of buffer accesses, synchronization.
#include "tests/source_core/test_scene.h"

using namespace render_system;
using namespace source_core_test;

namespace {

void expect_clean(const source_core::CoreTuning& tuning, bool all_features) {
    source_core::SourceOptions options;
    options.validate = true;
    OPEN_CORE_OR_SKIP(core, options, tuning);
    if (all_features) {
        ASSERT_TRUE(send_feature_scene(*core).ok());
    } else {
        std::mt19937 random(3);
        TestScene scene;
        scene.meshes.push_back(random_mesh(100, 1.0f, 0.5f, random));
        scene.instances.push_back({0, {}});
        ASSERT_TRUE(scene.send(*core).ok());
    }
    CoreSettings settings;
    settings.max_path_length = 4;
    ASSERT_TRUE(core->Setting(settings).ok());
    render(*core, 24, 16, 2);
    settings.max_path_length = 17;  // cut into several submissions
    ASSERT_TRUE(core->Setting(settings).ok());
    const std::vector<glm::vec4> unwatched = render(*core, 24, 16, 1);
    struct Shown final : PathWatch {
        uint64_t finished = 0;
        void after(const PathStates& states) override { finished += states.means.size() / 4; }
    } shown;
    ASSERT_TRUE(core->SetWatch(&shown).ok());
    EXPECT_EQ(render(*core, 24, 16, 1), unwatched);
    EXPECT_EQ(shown.finished, 24u * 16u) << "every path of every batch";
}

// By itself, and with a history: where that begins, and where the eye and an instance have moved.
void expect_clean_filters(const source_core::CoreTuning& tuning) {
    source_core::SourceOptions options;
    options.validate = true;
    OPEN_CORE_OR_SKIP(core, options, tuning);
    std::mt19937 random(3);
    TestScene scene;
    scene.meshes.push_back(random_mesh(100, 1.0f, 0.5f, random));
    scene.instances.push_back({0, {}});
    ASSERT_TRUE(scene.send(*core).ok());
    std::vector<glm::vec4> pixels(24 * 16), filtered(pixels.size());
    ASSERT_TRUE(core->SetTarget({24, 16, pixels}).ok());
    ViewPyramid view = front_view();
    const auto filter = [&](uint32_t frame, FilterHistory history) {
        ASSERT_TRUE(core->Render(view, Convergence::Restart, 1).ok());
        const CoreFilter wish = {.means = pixels,
                                 .first_sample = frame,
                                 .samples = 1,
                                 .filtered = filtered,
                                 .history = history,
                                 .most_rays = 4};
        const Status status = core->Filter(view, wish);
        EXPECT_TRUE(status.ok()) << status.message;
    };
    filter(0, FilterHistory::none);
    filter(1, FilterHistory::begin);
    view.eye.x = 0.5f;
    ASSERT_TRUE(core->SetInstance(0, 0, random_transform(0.1f, false, random)).ok());
    filter(2, FilterHistory::go_on);
}

// Core and synchronization checks only: GPU-assisted kernels take minutes to compile on a software device.
source_core::CoreTuning host_checks() {
    source_core::CoreTuning tuning;
    tuning.assisted_validation = false;
    return tuning;
}

}  // namespace

TEST(Validation, AllFeaturesRunClean) { expect_clean(host_checks(), true); }

TEST(Validation, StorageBuffersRunClean) {
    source_core::CoreTuning tuning = host_checks();
    tuning.table_access = source_core::TableAccess::storage;
    expect_clean(tuning, true);
}

TEST(Validation, DeviceAddressesRunClean) {
    source_core::CoreTuning tuning = host_checks();
    tuning.table_access = source_core::TableAccess::address;
    expect_clean(tuning, true);
}

TEST(Validation, BatchesRunClean) {
    source_core::CoreTuning tuning = host_checks();
    tuning.largest_batch = 128;
    expect_clean(tuning, true);
}

TEST(Validation, FiltersRunClean) {
    source_core::CoreTuning tuning = host_checks();
    tuning.largest_batch = 128;
    expect_clean_filters(tuning);
}

TEST(Validation, AccessesOnTheDeviceStayInside) { expect_clean({}, false); }

TEST(Validation, AccessesToStorageBuffersStayInside) {
    source_core::CoreTuning tuning;
    tuning.table_access = source_core::TableAccess::storage;
    expect_clean(tuning, false);
}

// Minutes on a software device: run by hand with --gtest_also_run_disabled_tests after a change to buffers or trace.
TEST(Validation, DISABLED_AccessesOfFiltersStayInside) { expect_clean_filters({}); }

TEST(Validation, DISABLED_AllAccessesStayInside) { expect_clean({}, true); }

TEST(Validation, DISABLED_AllAccessesToStorageBuffersStayInside) {
    source_core::CoreTuning tuning;
    tuning.table_access = source_core::TableAccess::storage;
    expect_clean(tuning, true);
}

TEST(Validation, ASceneOfNothingRunsClean) {
    source_core::SourceOptions options;
    options.validate = true;
    OPEN_CORE_OR_SKIP(core, options, host_checks());
    render(*core, 8, 8, 1);
}

TEST(Validation, AWriteOutsideABufferIsCaught) {
    // The layers must be awake for the tests above to mean anything.
    TemporaryFolder folder;
    folder.write_kernels();
    folder.write("finalize.glsl",
                 "#ifndef FINALIZE_GLSL\n#define FINALIZE_GLSL\n#include \"path_state.glsl\"\n"
                 "void finalize_pixel(Uint job) { store_target(job + 64u, vec4(1.0f)); }\n#endif\n");
    source_core::SourceOptions options;
    options.validate = true;
    options.kernels_directory = folder.path();
    source_core::CoreTuning tuning;
    tuning.largest_batch = 64;
    OPEN_CORE_OR_SKIP(core, options, tuning);
    std::vector<glm::vec4> pixels(64);
    ASSERT_TRUE(core->SetTarget({8, 8, pixels}).ok());
    const Status status = core->Render(front_view(), Convergence::Restart, 1);
    EXPECT_EQ(status.code, StatusCode::internal);
    EXPECT_NE(status.message.find("out of bounds"), std::string::npos) << status.message;
}
