// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The core as its caller sees it, on whatever Vulkan device there is.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "render_system/hot_kernels.h"
#include "tests/source_core/test_scene.h"

using namespace render_system;
using namespace source_core_test;

namespace {

bool same_bits(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

// One triangle that fills the view, sky of the given radiance.
TestScene one_triangle() {
    TestScene scene;
    scene.meshes.resize(1);
    scene.meshes[0].add_triangle({-10, -10, 0}, {10, -10, 0}, {0, 10, 0});
    scene.instances.push_back({0, {}});
    return scene;
}

float lightest(const std::vector<glm::vec4>& pixels) {
    float result = 0.0f;
    for (const glm::vec4& pixel : pixels) {
        result = std::max({result, pixel.x, pixel.y, pixel.z});
    }
    return result;
}

}  // namespace

TEST(SourceCore, SaysWhyThereIsNoDevice) {
    // The loader reads the variable when Vulkan is opened.
    setenv("VK_DRIVER_FILES", "/nonexistent/driver.json", 1);
    setenv("VK_ICD_FILENAMES", "/nonexistent/driver.json", 1);
    auto core = source_core::create_tuned_core({});
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const Status status = core->Init({});
    const std::string printed = ::testing::internal::GetCapturedStdout() + ::testing::internal::GetCapturedStderr();
    unsetenv("VK_DRIVER_FILES");
    unsetenv("VK_ICD_FILENAMES");
    EXPECT_EQ(status.code, StatusCode::no_device);
    EXPECT_NE(status.message.find("VK_DRIVER_FILES"), std::string::npos) << status.message;
    EXPECT_EQ(printed, "");
    EXPECT_EQ(core->SetTarget({}).code, StatusCode::wrong_order);
}

TEST(SourceCore, ASkyWithoutGeometryIsWhatEveryPixelShows) {
    OPEN_CORE_OR_SKIP(core);
    CoreSky sky;
    sky.radiance = {0.25f, 0.5f, 2.0f};
    ASSERT_TRUE(core->SetSkyData(sky).ok());
    for (const glm::vec4& pixel : render(*core, 13, 7, 3)) {
        EXPECT_EQ(pixel, glm::vec4(0.25f, 0.5f, 2.0f, 1.0f));
    }
    EXPECT_EQ(core->GetCoreStats().primary_rays, 13u * 7u * 3u);
    EXPECT_EQ(core->GetCoreStats().extension_rays, 0u);
}

TEST(SourceCore, BatchesDoNotShowInThePicture) {
    OPEN_CORE_OR_SKIP(whole);
    ASSERT_TRUE(send_feature_scene(*whole).ok());
    const auto expected = render(*whole, 61, 37, 2);
    EXPECT_GT(lightest(expected), 0.1f);
    source_core::CoreTuning tuning;
    tuning.largest_batch = 256;  // 61 * 37 = 2257 pixels: nine batches, the last one short
    OPEN_CORE_OR_SKIP(pieces, {}, tuning);
    ASSERT_TRUE(send_feature_scene(*pieces).ok());
    EXPECT_TRUE(same_bits(render(*pieces, 61, 37, 2), expected));
    EXPECT_EQ(whole->GetCoreStats().shadow_rays, pieces->GetCoreStats().shadow_rays);
}

TEST(SourceCore, TheWayToTheTablesDoesNotShowInThePicture) {
    OPEN_CORE_OR_SKIP(usual);
    ASSERT_TRUE(send_feature_scene(*usual).ok());
    const auto expected = render(*usual, 48, 32, 2);
    for (const auto access : {source_core::TableAccess::storage, source_core::TableAccess::address}) {
        source_core::CoreTuning tuning;
        tuning.table_access = access;
        OPEN_CORE_OR_SKIP(other, {}, tuning);
        ASSERT_TRUE(send_feature_scene(*other).ok());
        EXPECT_TRUE(same_bits(render(*other, 48, 32, 2), expected)) << static_cast<int>(access);
    }
}

TEST(SourceCore, SamplesAddUpWhereverTheyAreCut) {
    OPEN_CORE_OR_SKIP(core);
    ASSERT_TRUE(send_feature_scene(*core).ok());
    const auto expected = render(*core, 40, 24, 5);
    std::vector<glm::vec4> pixels(40 * 24);
    ASSERT_TRUE(core->SetTarget({40, 24, pixels}).ok());
    ASSERT_TRUE(core->Render(front_view(), Convergence::Restart, 2).ok());
    ASSERT_TRUE(core->Render(front_view(), Convergence::Converge, 1).ok());
    ASSERT_TRUE(core->Render(front_view(), Convergence::Converge, 2).ok());
    EXPECT_TRUE(same_bits(pixels, expected));
    EXPECT_EQ(core->GetCoreStats().samples, 5u);
}

TEST(SourceCore, FirstSampleStartsARangeOfTheSameSamples) {
    OPEN_CORE_OR_SKIP(core);
    ASSERT_TRUE(send_feature_scene(*core).ok());
    const auto all = render(*core, 16, 16, 2);
    const auto first = render(*core, 16, 16, 1);
    CoreSettings settings;
    settings.first_sample = 1;
    ASSERT_TRUE(core->Setting(settings).ok());
    const auto second = render(*core, 16, 16, 1);
    for (size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ((first[i].y + second[i].y) * 0.5f, all[i].y);
    }
}

TEST(SourceCore, LongPathsEndWhenNoRayIsLeft) {
    OPEN_CORE_OR_SKIP(core);
    ASSERT_TRUE(send_feature_scene(*core).ok());
    CoreSettings settings;
    settings.max_path_length = 20;
    ASSERT_TRUE(core->Setting(settings).ok());
    const auto longer = render(*core, 32, 32, 2);
    settings.max_path_length = 5000;  // would be 20,000 dispatches
    ASSERT_TRUE(core->Setting(settings).ok());
    const auto longest = render(*core, 32, 32, 2);
    EXPECT_EQ(longer.size(), longest.size());
    EXPECT_GT(core->GetCoreStats().extension_rays, 0u);
    settings.max_path_length = 20;
    ASSERT_TRUE(core->Setting(settings).ok());
    EXPECT_TRUE(same_bits(render(*core, 32, 32, 2), longer));
}

TEST(SourceCore, AnEditShowsInTheNextPicture) {
    OPEN_CORE_OR_SKIP(core);
    TestScene scene = one_triangle();
    scene.materials[0].emission = {3.0f, 2.0f, 1.0f};
    ASSERT_TRUE(scene.send(*core).ok());
    EXPECT_EQ(render(*core, 8, 8, 1)[36], glm::vec4(3.0f, 2.0f, 1.0f, 1.0f));
    scene.materials[0].emission = {1.0f, 1.0f, 5.0f};
    ASSERT_TRUE(core->SetMaterials(0, scene.materials).ok());
    EXPECT_EQ(render(*core, 8, 8, 1)[36], glm::vec4(1.0f, 1.0f, 5.0f, 1.0f));
    scene.materials[0].opaque = false;
    scene.materials[0].alpha = 0.0f;  // lets every ray through
    ASSERT_TRUE(core->SetMaterials(0, scene.materials).ok());
    EXPECT_EQ(render(*core, 8, 8, 1)[36], glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    scene.materials[0].alpha = 1.0f;
    ASSERT_TRUE(core->SetMaterials(0, scene.materials).ok());
    EXPECT_EQ(render(*core, 8, 8, 1)[36], glm::vec4(1.0f, 1.0f, 5.0f, 1.0f));
    ASSERT_TRUE(core->SetInstance(0, NONE, {}).ok());
    EXPECT_EQ(render(*core, 8, 8, 1)[36], glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    CoreTransform aside;
    aside.rows[0].w = 30.0f;
    ASSERT_TRUE(core->SetInstance(0, 0, aside).ok());
    EXPECT_EQ(render(*core, 8, 8, 1)[36], glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    ASSERT_TRUE(core->SetInstance(0, 0, {}).ok());
    EXPECT_EQ(render(*core, 8, 8, 1)[36], glm::vec4(1.0f, 1.0f, 5.0f, 1.0f));
}

TEST(SourceCore, MeshesOverTheBudgetAreRefusedBeforeATreeIsBuiltWithTheNeedOfThemAll) {
    source_core::SourceOptions options;
    options.memory_limit = 1 << 20;
    OPEN_CORE_OR_SKIP(core, options);
    std::mt19937 random(1);
    TestScene scene;
    for (uint32_t i = 0; i < 4; ++i) {
        scene.meshes.push_back(random_mesh(20000, 1.0f, 0.1f, random));
        scene.instances.push_back({i, {}});
    }
    ASSERT_TRUE(scene.send(*core).ok());
    std::vector<glm::vec4> pixels(64);
    ASSERT_TRUE(core->SetTarget({8, 8, pixels}).ok());
    const uint64_t before = core->GetCoreStats().memory_bytes;
    const Status status = core->Render(front_view(), Convergence::Restart, 1);
    EXPECT_EQ(status.code, StatusCode::out_of_memory);
    EXPECT_EQ(status.allowed_bytes, 1u << 20);
    // 64 bytes a triangle and 36 a vertex, before any node.
    EXPECT_GE(status.needed_bytes, 4 * (20000u * 64 + 60000u * 36));
    EXPECT_EQ(core->GetCoreStats().memory_bytes, before);
    EXPECT_EQ(core->GetCoreStats().build_ms, 0.0);
}

TEST(SourceCore, ASceneOverTheBudgetIsRefusedBeforeAnyUpload) {
    source_core::SourceOptions options;
    options.memory_limit = 12 << 20;  // meshes fit, with trees, staging and path state they do not
    OPEN_CORE_OR_SKIP(core, options);
    std::mt19937 random(1);
    TestScene scene;
    scene.meshes.push_back(random_mesh(40000, 1.0f, 0.1f, random));
    scene.instances.push_back({0, {}});
    ASSERT_TRUE(scene.send(*core).ok());
    std::vector<glm::vec4> pixels(64 * 64, glm::vec4(-1.0f));
    ASSERT_TRUE(core->SetTarget({64, 64, pixels}).ok());
    const Status status = core->Render(front_view(), Convergence::Restart, 1);
    EXPECT_EQ(status.code, StatusCode::out_of_memory);
    EXPECT_GT(status.needed_bytes, status.allowed_bytes);
    EXPECT_EQ(status.allowed_bytes, options.memory_limit);
    EXPECT_EQ(core->GetCoreStats().memory_bytes, 0u);
    EXPECT_EQ(pixels[0], glm::vec4(-1.0f));
}

TEST(SourceCore, TheBudgetHoldsAndIsStated) {
    OPEN_CORE_OR_SKIP(probe);
    ASSERT_TRUE(send_feature_scene(*probe).ok());
    const auto expected = render(*probe, 200, 200, 1);
    const uint64_t used = probe->GetCoreStats().memory_bytes;
    EXPECT_GT(probe->GetCoreStats().memory_allowed_bytes, used);
    source_core::SourceOptions options;
    options.memory_limit = used - 1000000;  // smaller batches help
    OPEN_CORE_OR_SKIP(tight, options);
    ASSERT_TRUE(send_feature_scene(*tight).ok());
    EXPECT_TRUE(same_bits(render(*tight, 200, 200, 1), expected));
    EXPECT_LE(tight->GetCoreStats().memory_bytes, options.memory_limit);
    EXPECT_EQ(tight->GetCoreStats().memory_allowed_bytes, options.memory_limit);
}

TEST(SourceCore, ABrokenKernelIsAnErrorWithFileAndLine) {
    TemporaryFolder folder;
    folder.write_kernels();
    folder.write("sky.glsl", "#ifndef SKY_GLSL\n#define SKY_GLSL\nfloat broken = nonsense;\n#endif\n");
    source_core::SourceOptions options;
    options.kernels_directory = folder.path();
    OPEN_CORE_OR_SKIP(core, options);
    std::vector<glm::vec4> pixels(4);
    ASSERT_TRUE(core->SetTarget({2, 2, pixels}).ok());
    const Status status = core->Render(front_view(), Convergence::Restart, 1);
    EXPECT_EQ(status.code, StatusCode::internal);
    EXPECT_NE(status.message.find("sky.glsl:3"), std::string::npos) << status.message;
    EXPECT_NE(status.message.find("nonsense"), std::string::npos) << status.message;
    EXPECT_EQ(status.message.find('\n'), std::string::npos) << status.message;
}

TEST(SourceCore, AnEditedKernelRunsFromTheNextRenderOnAndABrokenOneDoesNot) {
    TemporaryFolder folder;
    folder.write_kernels();
    const auto read = [&](const char* name) {
        std::ifstream file(folder.path() / name);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    source_core::SourceOptions options;
    options.kernels_directory = folder.path();
    OPEN_CORE_OR_SKIP(core, options);
    auto* hot = dynamic_cast<HotKernels*>(core.get());
    ASSERT_NE(hot, nullptr);
    CoreSky sky;
    sky.radiance = {0.25f, 0.5f, 2.0f};
    std::vector<glm::vec4> pixels(4);
    ASSERT_TRUE(core->SetSkyData(sky).ok() && core->SetTarget({2, 2, pixels}).ok());
    const auto expect_pixels = [&](float factor, uint64_t samples) {
        ASSERT_TRUE(core->Render(front_view(), Convergence::Converge, 1).ok());
        EXPECT_EQ(pixels[3], glm::vec4(factor * sky.radiance, 1.0f));
        EXPECT_EQ(core->GetCoreStats().samples, samples);
    };
    expect_pixels(1.0f, 1);
    EXPECT_EQ(hot->compile_again()->kernels, std::vector<std::string>());
    expect_pixels(1.0f, 2);

    const std::string finalize = read("finalize.glsl"), sky_text = read("sky.glsl"), sum = "sum * pass.sample_scale";
    std::string doubled = finalize;
    ASSERT_NE(doubled.find(sum), std::string::npos);
    doubled.replace(doubled.find(sum), sum.size(), "2.0 * " + sum);
    folder.write("finalize.glsl", doubled);
    EXPECT_EQ(hot->compile_again()->kernels, std::vector<std::string>{"finalize"});
    expect_pixels(2.0f, 1);  // samples of other kernels are not added up

    folder.write("finalize.glsl", doubled + "\nfloat broken = nonsense;\n");
    const Result<RecompiledKernels> broken = hot->compile_again();
    const auto lines = std::count(doubled.begin(), doubled.end(), '\n');
    EXPECT_EQ(broken.status.code, StatusCode::internal);
    EXPECT_NE(broken.status.message.find("finalize.glsl:" + std::to_string(lines + 2)), std::string::npos)
        << broken.status.message;
    expect_pixels(2.0f, 2);
    std::filesystem::remove(folder.path() / "finalize.glsl");
    EXPECT_EQ(hot->compile_again().status.code, StatusCode::not_found);
    expect_pixels(2.0f, 3);

    folder.write("finalize.glsl", finalize);
    folder.write("sky.glsl", "// edited\n" + sky_text);
    EXPECT_EQ(hot->compile_again()->kernels, (std::vector<std::string>{"extend", "shade", "finalize"}));
    folder.write("finalize.glsl", doubled);  // before anybody rendered
    EXPECT_EQ(hot->compile_again()->kernels, (std::vector<std::string>{"extend", "shade"}));
    expect_pixels(2.0f, 1);
    core->Shutdown();
    EXPECT_EQ(hot->compile_again().status.code, StatusCode::wrong_order);
}

TEST(SourceCore, KernelsThatNeverCompiledAreCompiledAtTheNextSaveAndNotOnlyWhenTheyAreToRun) {
    TemporaryFolder folder;
    folder.write_kernels();
    std::ifstream file(folder.path() / "finalize.glsl");
    const std::string finalize{std::istreambuf_iterator<char>(file), {}};
    const std::string broken = finalize + "\nfloat broken = nonsense;\n";
    folder.write("finalize.glsl", broken);
    source_core::SourceOptions options;
    options.kernels_directory = folder.path();
    OPEN_CORE_OR_SKIP(core, options);
    auto* hot = dynamic_cast<HotKernels*>(core.get());
    ASSERT_NE(hot, nullptr);
    std::vector<glm::vec4> pixels(4);
    ASSERT_TRUE(core->SetSkyData({}).ok() && core->SetTarget({2, 2, pixels}).ok());
    EXPECT_EQ(core->Render(front_view(), Convergence::Restart, 1).code, StatusCode::internal);
    for (const std::string& text : {broken, "// edited\n" + broken}) {
        folder.write("finalize.glsl", text);
        const Result<RecompiledKernels> again = hot->compile_again();
        EXPECT_EQ(again.status.code, StatusCode::internal) << again.status.message;
        EXPECT_NE(again.status.message.find("nonsense"), std::string::npos) << again.status.message;
    }
    folder.write("finalize.glsl", finalize);
    const Result<RecompiledKernels> whole = hot->compile_again();
    ASSERT_TRUE(whole.ok()) << whole.status.message;
    EXPECT_EQ(std::count(whole->kernels.begin(), whole->kernels.end(), "finalize"), 1);
    EXPECT_EQ(std::count(whole->kernels.begin(), whole->kernels.end(), "shade"), 1);
    EXPECT_TRUE(core->Render(front_view(), Convergence::Restart, 1).ok());
    EXPECT_EQ(hot->compile_again()->kernels, std::vector<std::string>());
}

/// Without a scene, and before anybody renders: what is broken is told, and of what compiles only what was edited is
/// looked at again.
TEST(SourceCore, KernelsAreHeldAgainstTheLanguageBeforeTheFirstRender) {
    TemporaryFolder folder;
    folder.write_kernels();
    std::ifstream file(folder.path() / "finalize.glsl");
    const std::string finalize{std::istreambuf_iterator<char>(file), {}};
    source_core::SourceOptions options;
    options.kernels_directory = folder.path();
    OPEN_CORE_OR_SKIP(core, options);
    auto* hot = dynamic_cast<HotKernels*>(core.get());
    ASSERT_NE(hot, nullptr);
    EXPECT_EQ(hot->compile_again()->kernels.size(), 9U);
    EXPECT_EQ(hot->compile_again()->kernels, std::vector<std::string>());
    folder.write("finalize.glsl", finalize + "\nfloat broken = nonsense;\n");
    for (int time = 0; time < 2; ++time) {
        const Result<RecompiledKernels> broken = hot->compile_again();
        EXPECT_EQ(broken.status.code, StatusCode::internal);
        EXPECT_NE(broken.status.message.find("nonsense"), std::string::npos) << broken.status.message;
    }
    folder.write("finalize.glsl", "// edited\n" + finalize);
    EXPECT_EQ(hot->compile_again()->kernels, std::vector<std::string>{"finalize"});
    // The scene's are those that were saved last.
    std::string doubled = finalize;
    const std::string sum = "sum * pass.sample_scale";
    ASSERT_NE(doubled.find(sum), std::string::npos);
    doubled.replace(doubled.find(sum), sum.size(), "2.0 * " + sum);
    folder.write("finalize.glsl", doubled);
    EXPECT_EQ(hot->compile_again()->kernels, std::vector<std::string>{"finalize"});
    CoreSky sky;
    sky.radiance = {0.25f, 0.5f, 2.0f};
    std::vector<glm::vec4> pixels(4);
    ASSERT_TRUE(core->SetSkyData(sky).ok() && core->SetTarget({2, 2, pixels}).ok());
    ASSERT_TRUE(core->Render(front_view(), Convergence::Restart, 1).ok());
    EXPECT_EQ(pixels[3], glm::vec4(2.0f * sky.radiance, 1.0f));
}

TEST(SourceCore, AMissingFolderOfKernelsIsNotFound) {
    source_core::SourceOptions options;
    options.kernels_directory = "/nonexistent/kernels";
    auto core = source_core::create_core(options);
    const Status status = core->Init({});
    EXPECT_EQ(status.code, StatusCode::not_found);
    EXPECT_NE(status.message.find("/nonexistent/kernels"), std::string::npos);
}

TEST(SourceCore, AMissingKernelIsNamed) {
    TemporaryFolder folder;
    folder.write_kernels();
    std::filesystem::remove(folder.path() / "shade.glsl");
    source_core::SourceOptions options;
    options.kernels_directory = folder.path();
    auto core = source_core::create_core(options);
    const Status status = core->Init({});
    EXPECT_EQ(status.code, StatusCode::not_found);
    EXPECT_NE(status.message.find("shade.glsl"), std::string::npos);
}
