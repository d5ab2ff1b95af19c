// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
//
// What the program promises of the two cores, on the built-in scene at small sizes. A core that this machine cannot run
// is skipped, with the reason shown.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/application/run_pathtracer.h"
#include "tests/application/skip_without_core.h"
#include "tests/application/small_scene.h"

namespace pathtracer_cores_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string SCENE = "still_life";
const std::string NO_VULKAN = "VK_DRIVER_FILES=/nowhere";

class Cores : public testing::Test {
protected:
    RunResult run(const std::vector<std::string>& arguments, const std::vector<std::string>& environment = {}) {
        return run_pathtracer(arguments, folder.path, environment);
    }
    /// The bytes of a small EXR of the built-in scene.
    std::string picture(const std::string& core, const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments = {"render", SCENE,   "--core", core, "--size",
                                              "96x54",  "--spp", "4",      "-o", "a.exr"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const RunResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return read_file(folder.path / "a.exr");
    }

    const TemporaryFolder folder;
};

class EachCore : public Cores, public testing::WithParamInterface<std::string> {};

INSTANTIATE_TEST_SUITE_P(, EachCore, testing::Values("source", "target"), [](const auto& core) { return core.param; });

TEST_P(EachCore, GivesAnotherFileForAnotherSeed) {
    SKIP_WITHOUT(GetParam());
    EXPECT_TRUE(picture(GetParam(), {"--seed", "1"}) != picture(GetParam(), {"--seed", "2"}));
}

TEST_P(EachCore, AFrameIsTheSameWhateverCameBefore) {
    SKIP_WITHOUT(GetParam());
    const std::string moving = write_moving_scene(folder.path).string();
    const auto rendered = [&](std::vector<std::string> which, const std::string& file) {
        std::vector<std::string> words = {
            "render",        moving,  "--core",     GetParam(),          "--size", "32x18", "--spp", "5", "--look-at",
            "0,1,4,0.5,0,0", "--sky", "1,0.5,0.25", "--max-path-length", "2"};
        words.insert(words.end(), which.begin(), which.end());
        const RunResult result = run(words);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return read_file(folder.path / file);
    };
    const auto last_frame = [&](const std::string& range) {
        return rendered({"--frames", range, "--fps", "4", "-o", "f#.exr"}, "f2.exr");
    };
    const std::string after_others = last_frame("0:3");
    EXPECT_TRUE(after_others == last_frame("2:3"));
    EXPECT_FALSE(after_others == read_file(folder.path / "f1.exr"));
    rendered({"--time", "0.5", "-o", "alone.exr"}, "alone.exr");
    const RunResult beside = run({"compare", "f2.exr", "alone.exr", "--format", "json"});
    ASSERT_EQ(beside.exit_code, 0) << beside.err;
    EXPECT_EQ(json::parse(beside.out)["results"][0]["identical_pixels"].get<double>(), 1.0);
}

TEST_P(EachCore, CountsItsRays) {
    SKIP_WITHOUT(GetParam());
    const RunResult result =
        run({"bench", SCENE, "--core", GetParam(), "--size", "96x54", "--spp", "3", "--format", "json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json bench = json::parse(result.out);
    const json& rays = bench["rays"];
    EXPECT_EQ(bench["core"], GetParam());
    EXPECT_EQ(rays["primary"], 96 * 54);
    EXPECT_GT(rays["extension"], 0);
    EXPECT_GT(rays["shadow"], 0);
    EXPECT_EQ(rays["total"].get<int>(),
              rays["primary"].get<int>() + rays["extension"].get<int>() + rays["shadow"].get<int>());
    EXPECT_GT(bench["ms_per_frame"]["total"], 0.0);
    EXPECT_GT(bench["ms_per_frame"]["extend"], 0.0);
    EXPECT_EQ(bench["embree_limit_mrays_per_s"].is_number(), GetParam() == "target");
}

TEST_P(EachCore, TracesNoShadowRaysWithoutNextEventEstimationAndNoBouncesAtLengthOne) {
    SKIP_WITHOUT(GetParam());
    picture(GetParam(), {"--no-nee", "--stats", "a.json"});
    EXPECT_EQ(json::parse(read_file(folder.path / "a.json"))["rays"]["shadow"], 0);
    picture(GetParam(), {"--max-path-length", "1", "--stats", "a.json"});
    const json rays = json::parse(read_file(folder.path / "a.json"))["rays"];
    EXPECT_EQ(rays["extension"], 0);
    EXPECT_EQ(rays["shadow"], 0);
}

TEST_F(Cores, CompareFindsThePicturesAlike) {
    SKIP_WITHOUT("source");
    SKIP_WITHOUT("target");
    const RunResult result = run({"compare", SCENE, "--size", "320x180", "--spp", "4,1", "--limit-ssim", "0.999",
                                  "--format", "json", "-o", "dir"});
    ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
    const json comparison = json::parse(result.out);
    ASSERT_EQ(comparison["results"].size(), 2u);
    EXPECT_EQ(comparison["results"][0]["spp"], 4) << "results come in the order asked for";
    EXPECT_EQ(comparison["results"][1]["spp"], 1);
    EXPECT_GE(comparison["results"][0]["ssim"], 0.9999);
    EXPECT_LE(comparison["results"][1]["pixels_off"], 0.0002);
    EXPECT_EQ(files_in(folder.path / "dir"),
              (std::vector<std::string>{"difference_1spp.png", "difference_4spp.png", "source_1spp.png",
                                        "source_4spp.png", "target_1spp.png", "target_4spp.png"}));
}

// A target core with another seed differs from the source core as it does from itself.
TEST_F(Cores, ASeedOfItsOwnForTheTargetCoreGivesTheNoiseOfOneCore) {
    SKIP_WITHOUT("source");
    SKIP_WITHOUT("target");
    const RunResult cores = run({"compare", SCENE, "--size", "96x54", "--spp", "4", "--exact", "--seed", "1",
                                 "--seed-target", "7", "--format", "json"});
    ASSERT_EQ(cores.exit_code, 0) << cores.err;
    picture("target", {"--exact", "--seed", "1"});
    std::filesystem::rename(folder.path / "a.exr", folder.path / "b.exr");
    picture("target", {"--exact", "--seed", "7"});
    const RunResult files = run({"compare", "b.exr", "a.exr", "--format", "json"});
    ASSERT_EQ(files.exit_code, 0) << files.err;
    json noise = json::parse(cores.out)["results"][0], of_target = json::parse(files.out)["results"][0];
    EXPECT_GT(noise["rmse"], 5.0);
    // A rendering adds its samples exactly, a comparison as the cores do: their last bits differ.
    EXPECT_NEAR(noise["rmse_linear"].get<double>(), of_target["rmse_linear"].get<double>(), 1e-6);
    for (json* figures : {&noise, &of_target}) {
        figures->erase("spp");
        figures->erase("rmse_linear");
    }
    EXPECT_EQ(noise, of_target);
    EXPECT_EQ(json::parse(cores.out)["seed_target"], 7);
}

TEST_F(Cores, CompareTellsBiasFromNoise) {
    SKIP_WITHOUT("source");
    SKIP_WITHOUT("target");
    const std::vector<std::string> words = {"compare", SCENE, "--bias",   "--size", "48x27",
                                            "--spp",   "32",  "--format", "json"};
    const RunResult result = run(words);
    ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
    const json bias = json::parse(result.out)["bias"];
    EXPECT_EQ(bias["verdict"], "too_few") << "1,296 pixels do not show a bias of 1 % in 32 samples";
    EXPECT_GT(bias["samples_needed"], 32);
    EXPECT_GT(bias["p_value"], 0.001);
    EXPECT_LT(std::abs(bias["mean_difference"].get<double>()), 6 * bias["standard_error"].get<double>());

    // Kernels that let too much light through.
    std::filesystem::copy(SOURCE_KERNELS, folder.path / "kernels");
    std::string text = read_file(folder.path / "kernels/finalize.glsl");
    const std::string mean = "sum * pass.sample_scale";
    ASSERT_NE(text.find(mean), std::string::npos);
    text.replace(text.find(mean), mean.size(), "1.25f * " + mean);
    std::ofstream(folder.path / "kernels/finalize.glsl") << text;
    std::vector<std::string> edited = words;
    edited.insert(edited.end(), {"--kernels", "kernels", "-o", "out"});
    const RunResult brighter = run(edited);
    EXPECT_EQ(brighter.exit_code, 1) << brighter.err << brighter.out;
    const json found = json::parse(brighter.out)["bias"];
    EXPECT_EQ(found["verdict"], "differ");
    EXPECT_LT(found["mean_difference"], 0.0) << "target - source";
    EXPECT_THAT(files_in(folder.path / "out"), testing::Contains("bias.png"));
}

TEST_F(Cores, CompareExitsWithOneExactlyBelowTheLimit) {
    SKIP_WITHOUT("source");
    SKIP_WITHOUT("target");
    const RunResult result =
        run({"compare", SCENE, "--size", "96x54", "--spp", "2", "--limit-ssim", "1", "--format", "json"});
    const double ssim = json::parse(result.out)["results"][0]["ssim"];
    EXPECT_EQ(result.exit_code, ssim < 1.0 ? 1 : 0);
}

TEST_F(Cores, APictureDoesNotDependOnThePortionsItWasRenderedIn) {
    SKIP_WITHOUT("source");
    SKIP_WITHOUT("target");
    ASSERT_EQ(run({"compare", SCENE, "--size", "96x54", "--spp", "1,3,7", "-o", "portions"}).exit_code, 0);
    ASSERT_EQ(run({"compare", SCENE, "--size", "96x54", "--spp", "7", "-o", "whole"}).exit_code, 0);
    for (const char* file : {"source_7spp.png", "target_7spp.png"}) {
        EXPECT_TRUE(read_file(folder.path / "portions" / file) == read_file(folder.path / "whole" / file)) << file;
    }
}

TEST_F(Cores, AgreeInEveryBitInExactModeOnTheParityScene) {
    SKIP_WITHOUT("source");
    SKIP_WITHOUT("target");
    const RunResult result = run({"compare", PARITY_SCENE, "--sky", PARITY_SKY, "--size", "320x180", "--spp", "1,3",
                                  "--exact", "--format", "json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    for (const json& comparison : json::parse(result.out)["results"]) {
        EXPECT_EQ(comparison["identical_pixels"], 1.0) << comparison;
    }
}

TEST_F(Cores, AgreeInEveryBitInExactModeThroughALens) {
    SKIP_WITHOUT("source");
    SKIP_WITHOUT("target");
    const RunResult result = run({"compare", SCENE, "--size", "96x54", "--spp", "2", "--exact", "--aperture", "0.1",
                                  "--focus", "3", "--format", "json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(json::parse(result.out)["results"][0]["identical_pixels"], 1.0);
}

TEST_F(Cores, AFilteredPictureHasTheSameBitsInExactModeAndDiffersFromAnUnfilteredOne) {
    SKIP_WITHOUT("source");
    SKIP_WITHOUT("target");
    const auto filtered = [&](const std::string& core, const std::string& name, const std::string& filter) {
        const RunResult result = run({"render", SCENE, "--core", core, "--size", "50x37", "--spp", "3", "--exact",
                                      "--filter", filter, "-o", name, "--format", "json"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(json::parse(result.out)["size"], json({50, 37})) << "the result is on stdout, a file or not";
    };
    filtered("source", "source.exr", "spatial");
    filtered("target", "target.exr", "spatial");
    filtered("target", "none.exr", "none");
    const auto identical = [&](const std::string& a, const std::string& b) {
        const RunResult result = run({"compare", a, b, "--format", "json"});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return json::parse(result.out)["results"][0]["identical_pixels"].get<double>();
    };
    EXPECT_EQ(identical("source.exr", "target.exr"), 1.0);
    EXPECT_LT(identical("target.exr", "none.exr"), 0.9);
    const RunResult merged = run({"merge", "target.exr", "-o", "merged.exr"});
    EXPECT_EQ(merged.exit_code, 2);
    EXPECT_THAT(merged.err, HasSubstr("--filter"));
}

TEST_F(Cores, AFilterOverFramesHasTheSameBitsInExactModeAtEveryFrame) {
    SKIP_WITHOUT("source");
    SKIP_WITHOUT("target");
    const std::string moving = write_moving_scene(folder.path).string();
    for (const std::string core : {"source", "target"}) {
        const std::vector<std::string> common = {"--core", core, "--size", "50x37", "--exact", "--filter", "temporal"};
        std::vector<std::string> still = {"render", SCENE, "--spp", "3", "-o", core + ".exr"};
        still.insert(still.end(), common.begin(), common.end());
        EXPECT_EQ(run(still).exit_code, 0);
        std::vector<std::string> frames = {"render", moving, "--frames", "0:3", "--spp", "2", "-o", core + "_#.exr"};
        frames.insert(frames.end(), common.begin(), common.end());
        EXPECT_EQ(run(frames).exit_code, 0);
    }
    for (const std::string name : {"", "_0", "_1", "_2"}) {
        const RunResult result =
            run({"compare", "source" + name + ".exr", "target" + name + ".exr", "--format", "json"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(json::parse(result.out)["results"][0]["identical_pixels"].get<double>(), 1.0) << name;
    }
    // The first frame of a sequence has no history, wherever it begins; the next one has.
    EXPECT_EQ(run({"render", moving, "--frames", "2:3", "--spp", "2", "-o", "alone_#.exr", "--core", "target", "--size",
                   "50x37", "--exact", "--filter", "temporal"})
                  .exit_code,
              0);
    const RunResult alone = run({"compare", "alone_2.exr", "target_2.exr", "--format", "json"});
    EXPECT_LT(json::parse(alone.out)["results"][0]["identical_pixels"].get<double>(), 0.9);
}

/// There is no camera: where the frames are seen from does not depend on which of them are asked for.
TEST_F(Cores, AFrameIsTheSameInAnyRangeWithoutACameraToo) {
    SKIP_WITHOUT("target");
    const std::string moving = write_moving_scene(folder.path).string();
    for (const std::string range : {"0:3", "2:3"})
        EXPECT_EQ(run({"render", moving, "--frames", range, "--fps", "3", "--spp", "1", "--core", "target", "--size",
                       "50x37", "-o", "of" + range.substr(0, 1) + "_#.png"})
                      .exit_code,
                  0);
    EXPECT_TRUE(read_file(folder.path / "of0_2.png") == read_file(folder.path / "of2_2.png"));
}

/// What moves the triangle is no matter: it is in one place, and what was seen of it is found where it was.
TEST_F(Cores, AFilterFollowsSkinsAndMorphsAsItDoesNodes) {
    SKIP_WITHOUT("source");
    SKIP_WITHOUT("target");
    for (const std::string what : {"node", "skin", "morph"}) {
        const std::string scene = write_moving_scene_by(what, folder.path).string();
        for (const std::string core : {"source", "target"}) {
            if (what == "node" && core == "source") continue;  // the test before
            const RunResult result =
                run({"render", scene, "--core", core, "--frames", "0:3", "--fps", "6", "--spp", "2", "--size", "50x37",
                     "--exact", "--filter", "temporal", "--look-at", "0,0,3,0,0,0", "-o", what + core + "_#.exr"});
            EXPECT_EQ(result.exit_code, 0) << result.err;
        }
    }
    const auto figures = [&](const std::string& a, const std::string& b) {
        const RunResult result = run({"compare", a, b, "--format", "json"});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return json::parse(result.out)["results"][0];
    };
    for (const std::string what : {"skin", "morph"}) {
        for (const std::string frame : {"_0.exr", "_1.exr", "_2.exr"}) {
            const json cores = figures(what + "source" + frame, what + "target" + frame);
            EXPECT_EQ(cores["identical_pixels"].get<double>(), 1.0) << what << frame;
            const json ways = figures(what + "target" + frame, "nodetarget" + frame);
            EXPECT_LT(ways["rmse"].get<double>(), 0.01) << what << frame << ways.dump();
        }
    }
}

/// Frames as well: filtered_runs_test.py.
TEST_F(Cores, AFilterOverFramesIsTakenUpAgainToTheSameBits) {
    for (const std::string core : {"source", "target"}) {
        SKIP_WITHOUT(core);
        const auto filtered = [&](std::vector<std::string> arguments) {
            const std::vector<std::string> common = {"--core", core, "--size", "50x37", "--filter", "temporal"};
            arguments.insert(arguments.begin(), "render");
            arguments.insert(arguments.end(), common.begin(), common.end());
            const RunResult result = run(arguments);
            EXPECT_EQ(result.exit_code, 0) << result.err;
            return result.err;
        };
        filtered({SCENE, "--spp", "5", "-o", "whole.exr"});
        filtered({SCENE, "--spp", "1000000", "--time-limit", "0.001s", "--checkpoint", "1h", "-o", "parts.exr"});
        EXPECT_THAT(filtered({SCENE, "--spp", "5", "--resume", "-o", "parts.exr"}), HasSubstr("going on after 1 "));
        EXPECT_TRUE(read_file(folder.path / "parts.exr") == read_file(folder.path / "whole.exr")) << core;
    }
}

TEST_F(Cores, PartsOfAPictureAreNotFiltered) {
    SKIP_WITHOUT("target");
    const RunResult result =
        run({"render", SCENE, "--core", "target", "--samples", "0:2", "--filter", "spatial", "-o", "part.exr"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("--samples"));
    EXPECT_FALSE(std::filesystem::exists(folder.path / "part.exr"));
}

TEST_F(Cores, WithoutVulkanTheTargetCoreStillWorks) {
    SKIP_WITHOUT("target");
    const std::string expected = picture("target");
    const RunResult refused = run({"render", SCENE, "--core", "source", "-o", "b.exr"}, {NO_VULKAN});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, Not(IsEmpty()));
    EXPECT_EQ(files_in(folder.path), std::vector<std::string>{"a.exr"});
    const RunResult result =
        run({"render", SCENE, "--size", "96x54", "--spp", "4", "-o", "b.exr", "--stats", "b.json"}, {NO_VULKAN});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("target"));
    EXPECT_TRUE(read_file(folder.path / "b.exr") == expected);
    EXPECT_EQ(json::parse(read_file(folder.path / "b.json"))["core"], "target");
}

TEST_F(Cores, WithoutAGpuTheTargetCoreComesFirst) {
    SKIP_WITHOUT("source");
    SKIP_WITHOUT("target");
    const json info = json::parse(run({"info", "--format", "json"}).out);
    const bool software = info["cores"][0]["device"].get<std::string>().find("llvmpipe") != std::string::npos;
    if (!software) GTEST_SKIP() << "there is a GPU";
    const RunResult result = run({"render", SCENE, "--size", "16x9", "--spp", "1", "-o", "a.png", "--stats", "s.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("core target: the scene fits; core source has no GPU here"));
    const json stats = json::parse(read_file(folder.path / "s.json"));
    EXPECT_EQ(stats["core"], "target");
    EXPECT_THAT(stats["core_reason"].get<std::string>(), HasSubstr("no GPU"));
}

TEST_F(Cores, WhatDoesNotFitTheDeviceIsLeftToTheTargetCore) {
    SKIP_WITHOUT("source");
    SKIP_WITHOUT("target");
    const std::string expected = picture("target");
    const RunResult both = run({"compare", SCENE, "--gpu-memory-limit", "1"});
    EXPECT_EQ(both.exit_code, 2);
    EXPECT_THAT(both.err, testing::Not(HasSubstr("--core")));  // which compare leaves aside
    EXPECT_THAT(both.err, HasSubstr("raise --gpu-memory-limit"));
    const RunResult refused = run({"render", SCENE, "--core", "source", "--gpu-memory-limit", "1", "-o", "b.exr"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("MiB"));
    const RunResult result = run({"render", SCENE, "--core", "source,target", "--gpu-memory-limit", "1", "--size",
                                  "96x54", "--spp", "4", "-o", "b.exr", "--stats", "s.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, testing::ContainsRegex("target.*MiB.*MiB"));
    EXPECT_TRUE(read_file(folder.path / "b.exr") == expected);
    EXPECT_THAT(json::parse(read_file(folder.path / "s.json"))["core_reason"].get<std::string>(), HasSubstr("MiB"));
}

TEST_F(Cores, AnInterruptedRenderingLeavesNothingUnfinishedBehind) {
    SKIP_WITHOUT("target");
    const RunResult result =
        run_program({"timeout", "-s", "INT", "1", PATHTRACER, "render", SCENE, "--core", "target", "--spp", "1000000"},
                    folder.path);
    EXPECT_EQ(result.exit_code, 124) << "it should have been interrupted: " << result.err;
    // The picture so far, where a sample was taken by then.
    EXPECT_THAT(files_in(folder.path), testing::AnyOf(IsEmpty(), testing::ElementsAre("still_life.png")));
}

}  // namespace
}  // namespace pathtracer_cores_test
