// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Renders under the validation layers: core checks, GPU-assisted checks of buffer accesses, synchronization. Accesses
// of filters are checked by kernels of our own.
#include <fstream>
#include <functional>
#include <iterator>

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

struct FilterTrial {
    uint32_t width = 24;
    uint32_t height = 16;
    uint32_t largest_batch = 128;
};

// By itself, and with a history: where that begins, where the eye and an instance have moved, where vertices have as
// well; then once more by itself. `look` is shown each picture.
void filter_frames(CoreAPI& core, const FilterTrial& trial,
                   const std::function<void(const std::vector<glm::vec4>&)>& look) {
    std::mt19937 random(3);
    TestScene scene;
    scene.meshes.push_back(random_mesh(100, 1.0f, 0.5f, random));
    scene.meshes.push_back(random_mesh(20, 1.0f, 0.5f, random));
    scene.instances = {{0, {}}, {1, {}}};
    ASSERT_TRUE(scene.send(core).ok());
    std::vector<glm::vec4> pixels(size_t{trial.width} * trial.height), filtered(pixels.size());
    ASSERT_TRUE(core.SetTarget({trial.width, trial.height, pixels}).ok());
    ViewPyramid view = front_view();
    const auto filter = [&](uint32_t frame, FilterHistory history) {
        const Status rendered = core.Render(view, Convergence::Restart, 1);
        ASSERT_TRUE(rendered.ok()) << rendered.message;
        const CoreFilter wish = {.means = pixels,
                                 .first_sample = frame,
                                 .samples = 1,
                                 .filtered = filtered,
                                 .history = history,
                                 .most_rays = 4};
        const Status status = core.Filter(view, wish);
        EXPECT_TRUE(status.ok()) << status.message;
        look(filtered);
    };
    filter(0, FilterHistory::none);
    filter(1, FilterHistory::begin);
    view.eye.x = 0.5f;
    ASSERT_TRUE(core.SetInstance(0, 0, random_transform(0.1f, false, random)).ok());
    filter(2, FilterHistory::go_on);
    for (glm::vec3& position : scene.meshes[1].positions) position.x += 0.1f;
    ASSERT_TRUE(core.SetGeometry(1, scene.meshes[1].view()).ok());
    filter(3, FilterHistory::go_on);
    filter(4, FilterHistory::none);
}

// Texts as they are, but that each access to a row of a buffer or table is held against what is bound there. The first
// one outside of that marks a word that no kernel uses, and from then on filtered pictures are OUTSIDE. For what
// filters reach, in seconds; the layers' own kernels take longer to compile than a test may.
constexpr float OUTSIDE = -1234.5f;

std::string replaced(const std::string& text, const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << "the kernels no longer say: " << from;
    return at == std::string::npos ? text : text.substr(0, at) + to + text.substr(at + from.size());
}

void write_kernels_that_tell(const TemporaryFolder& folder, const std::string& from = "", const std::string& to = "") {
    folder.write_kernels();
    std::ifstream file(folder.path() / "buffers.glsl");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::string arguments =
        "layout(set = 0, binding = BINDING_ARGUMENTS, std430) restrict buffer ArgumentsBlock { uint arguments[]; };\n";
    text = replaced(text, arguments, "");
    text = replaced(text, "// ---- Scene tables ----\n",
                    arguments +
                        "uint inside(uint index, int length) {\n"
                        "    if (index >= uint(length)) { arguments[ARGUMENTS_WORDS - 1u] = 0xBADBADu; }\n"
                        "    return min(index, uint(length) - 1u);\n"
                        "}\n");
    text = replaced(text, "return name##_table[row];", "return name##_table[inside(row, name##_table.length())];");
    text = replaced(text, "return name##_rows[index];", "return name##_rows[inside(index, name##_rows.length())];");
    text = replaced(text, "name##_rows[index] = row;", "name##_rows[inside(index, name##_rows.length())] = row;");
    text = replaced(text, "store_filter_picture(pixel, row, true);",
                    "store_filter_picture(pixel, arguments[ARGUMENTS_WORDS - 1u] == 0xBADBADu ? vec4(" +
                        std::to_string(OUTSIDE) + "f) : row, true);");
    if (!from.empty()) text = replaced(text, from, to);
    folder.write("buffers.glsl", text);
}

bool tells_of_accesses_outside(const TemporaryFolder& folder, const FilterTrial& trial) {
    source_core::SourceOptions options;
    options.kernels_directory = folder.path();
    source_core::CoreTuning tuning;
    tuning.largest_batch = trial.largest_batch;
    tuning.table_access = source_core::TableAccess::storage;  // of which a text can ask how large they are
    const auto core = open_core(options, tuning);
    if (!core) {
        [] { GTEST_SKIP() << last_open_error(); }();
        return false;
    }
    bool tells = false;
    filter_frames(*core, trial, [&](const std::vector<glm::vec4>& picture) {
        for (const glm::vec4& pixel : picture) tells = tells || pixel.x == OUTSIDE;
    });
    return tells;
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
    const FilterTrial trial;
    tuning.largest_batch = trial.largest_batch;
    source_core::SourceOptions options;
    options.validate = true;
    OPEN_CORE_OR_SKIP(core, options, tuning);
    filter_frames(*core, trial, [](const std::vector<glm::vec4>&) {});
}

TEST(Validation, AccessesOfFiltersStayInside) {
    const TemporaryFolder folder;
    write_kernels_that_tell(folder);
    // Pictures of a few rows and columns as well: there most taps of a filter are outside.
    for (const FilterTrial& trial : {FilterTrial{}, FilterTrial{17, 5, 64}, FilterTrial{1, 1, 64}}) {
        EXPECT_FALSE(tells_of_accesses_outside(folder, trial)) << trial.width << "x" << trial.height;
        if (IsSkipped()) return;
    }
}

TEST(Validation, AnAccessOfAFilterOutsideIsTold) {
    const TemporaryFolder folder;
    const auto with = [&](const std::string& text, const std::string& other) {
        write_kernels_that_tell(folder, text, other);
        return tells_of_accesses_outside(folder, {});
    };
    EXPECT_TRUE(with("Uint(clamp(Int(pixels), 0, int(settings.pixel_count) - 1))", "pixels")) << "planes";
    if (IsSkipped()) return;
    EXPECT_TRUE(with("load_filter_picture(settings.pixel_count + first",
                     "load_filter_picture(2u * settings.pixel_count + first"))
        << "motions";
}

TEST(Validation, AccessesOnTheDeviceStayInside) { expect_clean({}, false); }

TEST(Validation, AccessesToStorageBuffersStayInside) {
    source_core::CoreTuning tuning;
    tuning.table_access = source_core::TableAccess::storage;
    expect_clean(tuning, false);
}

// Minutes on a software device: run by hand with --gtest_also_run_disabled_tests after a change to buffers or trace.
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
