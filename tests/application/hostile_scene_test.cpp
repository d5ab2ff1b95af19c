// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0

// Scenes that somebody made to do harm, and files that are none: each is refused with exit code 2 and one line, at
// once, and what lies just inside a limit renders on every core.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/application/run_pathtracer.h"
#include "tests/application/skip_without_core.h"
#include "tests/application/small_scene.h"

namespace hostile_scene_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

class HostileScene : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(folder.path / "scene");
        write_small_scene(folder.path / "scene");
        small = json::parse(read_file(folder.path / "scene/triangle.gltf"));
        std::ofstream(folder.path / "outside.bin") << positions();
    }

    /// The bytes that the scene's data URI holds: three points, written out.
    static std::string positions() {
        const float values[9] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
        return {reinterpret_cast<const char*>(values), sizeof(values)};
    }

    void write(const json& document) { std::ofstream(folder.path / "scene/a.gltf") << document.dump(); }

    RunResult render(const std::vector<std::string>& more, const std::string& core = "null") {
        std::vector<std::string> words = {"timeout", "20",   PATHTRACER, "render", "scene/a.gltf", "--core", core,
                                          "--size",  "16x9", "--spp",    "1",      "-o",           "a.png",  "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        fs::remove(folder.path / "a.png");
        return run_program(words, folder.path);
    }

    void expect_refused(const std::vector<std::string>& words, const std::vector<std::string>& more = {}) {
        const RunResult result = render(more);
        EXPECT_EQ(result.exit_code, 2) << result.err;
        EXPECT_THAT(result.out, IsEmpty());
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        for (const std::string& word : words) EXPECT_THAT(result.err, HasSubstr(word));
        EXPECT_FALSE(fs::exists(folder.path / "a.png"));
    }

    void expect_rendered(const std::vector<std::string>& more = {}) {
        const RunResult result = render(more);
        EXPECT_EQ(result.exit_code, 0) << result.err;
    }

    const TemporaryFolder folder;
    json small;
};

TEST_F(HostileScene, UrisThatLeaveItsFolderAreRefusedUnlessAllowed) {
    small["buffers"][0]["uri"] = "%2e%2e/outside.bin";
    write(small);
    expect_refused({"scene/a.gltf: /buffers/0/uri: \"%2e%2e/outside.bin\"", "leads out", "--allow-outside"});
    expect_rendered({"--allow-outside"});
}

TEST_F(HostileScene, APipeIsRefusedAtOnce) {
    write(small);
    ASSERT_EQ(mkfifo((folder.path / "pipe.hdr").c_str(), 0600), 0);
    expect_refused({"pipe.hdr: is not a regular file but a pipe"}, {"--camera", "pipe.hdr"});
    expect_refused({"pipe.hdr: is not a regular file but a pipe"}, {"--sky", "pipe.hdr"});
    fs::remove(folder.path / "scene/a.gltf");
    fs::create_symlink("../pipe.hdr", folder.path / "scene/a.gltf");
    expect_refused({"scene/a.gltf: is not a regular file but a pipe"});
}

// A scene and an eye just before the limits, on both cores at once: starting one costs more than the picture.
TEST_F(HostileScene, WhatIsPastTheLimitsIsRefusedAndWhatIsBeforeThemRenders) {
    const auto camera = [&](const std::string& position) {
        std::ofstream(folder.path / "c.json")
            << R"({"position": )" << position << R"(, "target": [0, 0, 0], "up": [0, 1, 0], "vfov_degrees": 40})";
        return std::vector<std::string>{"--camera", "c.json"};
    };
    json twice = small;  // traced in the mesh's own space
    twice["nodes"].push_back({{"mesh", 0}, {"scale", {9.9e8, 9.9e8, 9.9e8}}});
    twice["nodes"].push_back({{"mesh", 0}, {"scale", {1e-9, 1e-9, 1e-9}}});
    twice["scenes"][0]["nodes"] = {0, 1};
    write(twice);
    expect_refused({"c.json: /position", "2e+18"}, camera("[2e18, 0, 1]"));
    for (const char* core : {"target", "source"}) {
        SKIP_WITHOUT(core);
        const RunResult result = render(camera("[9.9e11, 0, 1]"), core);
        EXPECT_EQ(result.exit_code, 0) << result.err;
    }
    twice["scenes"][0]["nodes"] = {0, 1, 2};
    write(twice);
    expect_refused({"scene/a.gltf: instance 2", "scales so far down"});
}

TEST_F(HostileScene, AKernelThatIsAPipeIsRefused) {
    SKIP_WITHOUT("source");
    write(small);
    fs::create_directory(folder.path / "kernels");
    for (const auto& entry : fs::directory_iterator(SOURCE_KERNELS)) {
        if (entry.is_regular_file()) fs::copy(entry.path(), folder.path / "kernels" / entry.path().filename());
    }
    fs::remove(folder.path / "kernels/extend.comp");
    ASSERT_EQ(mkfifo((folder.path / "kernels/extend.comp").c_str(), 0600), 0);
    const RunResult result = render({"--kernels", "kernels"}, "source");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("kernels/extend.comp: is not a regular file but a pipe"));
}

TEST_F(HostileScene, BombsAreRefusedBeforeTheyTakeMemory) {
    // 4 GiB of addresses: more than enough for the program, less than any of these would take.
    const std::string command = std::string("ulimit -v 4194304; exec timeout 20 ") + PATHTRACER +
                                " render scene/a.gltf --core null -o a.png --quiet";
    json document = small;  // 10,000 times the same positions
    constexpr size_t TRIANGLES = 40960;
    const std::string many(36 * TRIANGLES, '\0');
    std::ofstream(folder.path / "scene/many.bin") << many;
    document["buffers"][0] = {{"byteLength", many.size()}, {"uri", "many.bin"}};
    document["bufferViews"][0]["byteLength"] = many.size();
    document["accessors"][0]["count"] = 3 * TRIANGLES;
    const json primitive = document["meshes"][0]["primitives"][0];
    for (int i = 0; i < 10000; ++i) document["meshes"][0]["primitives"].push_back(primitive);
    write(document);
    const RunResult many_times = run_program({"sh", "-c", command}, folder.path);
    EXPECT_EQ(many_times.exit_code, 2);
    EXPECT_THAT(many_times.err, HasSubstr("memory"));
}

}  // namespace
}  // namespace hostile_scene_test
