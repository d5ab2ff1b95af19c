// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
//
// What threads may not change. ./test.sh --tsan runs this once more under the thread sanitizer, where the program
// exits with 66 if it finds a race.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/application/run_pathtracer.h"
#include "tests/application/skip_without_core.h"

namespace threads_test {
namespace {

const std::string SCENE = "still_life";

class Threads : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override {
        SKIP_WITHOUT(GetParam());
#ifdef __SANITIZE_THREAD__
        if (GetParam() == "source") GTEST_SKIP() << "the sanitizer cannot see into the Vulkan driver's threads";
#endif
    }
    /// The bytes of a small EXR of the built-in scene.
    std::string picture(const std::vector<std::string>& more, const std::string& size = "96x54",
                        const std::string& spp = "4") {
        std::vector<std::string> arguments = {"render", SCENE,   "--core", GetParam(), "--size",
                                              size,     "--spp", spp,      "-o",       "a.exr"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const RunResult result = run_pathtracer(arguments, folder.path);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_THAT(result.err, testing::StartsWith("a.exr: " + size + ", " + spp +
                                                    (spp == "1" ? " sample" : " samples") + " per pixel"));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << "no library may talk on its own";
        return read_file(folder.path / "a.exr");
    }

    const TemporaryFolder folder;
};

INSTANTIATE_TEST_SUITE_P(Each, Threads, testing::Values("source", "target"),
                         [](const auto& core) { return core.param; });

TEST_P(Threads, NeverChangeThePicture) {
    const std::string first = picture({});
    ASSERT_FALSE(first.empty());
    for (const char* threads : {"1", "2", "5"}) {
        for (int repetition = 0; repetition < 3; ++repetition) {
            EXPECT_TRUE(picture({"--threads", threads}) == first) << threads << " threads";
        }
    }
}

// The target core cuts this picture into tiles of 1,808 paths for one thread and of 368 for five.
TEST_P(Threads, NeverChangeAPictureOfManyTiles) {
    EXPECT_TRUE(picture({"--threads", "1"}, "320x180", "1") == picture({"--threads", "5"}, "320x180", "1"));
}

TEST_P(Threads, NeverChangeTheExactPicture) {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "the sanitizer cannot see that Embree's threads are done with our callbacks when it has built";
#endif
    EXPECT_TRUE(picture({"--exact", "--threads", "1"}) == picture({"--exact", "--threads", "4"}));
}

TEST_P(Threads, ShareTheWorkOfABenchmark) {
    const RunResult result = run_pathtracer(
        {"bench", SCENE, "--core", GetParam(), "--size", "96x54", "--spp", "2", "--threads", "4"}, folder.path);
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

}  // namespace
}  // namespace threads_test
