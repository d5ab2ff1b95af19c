// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/application/run_pathtracer.h"
#include "tests/application/small_scene.h"

namespace pathtracer_cli_test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Pathtracer : public testing::Test {
protected:
    RunResult run(const std::vector<std::string>& arguments, const std::vector<std::string>& environment = {}) {
        return run_pathtracer(arguments, folder.path, environment);
    }
    /// render on the null core, quickly.
    RunResult render(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"render", scene, "--core", "null", "--size", "16x9", "--spp", "2"});
        return run(arguments);
    }
    /// Exit 2, an empty stdout, one or two lines on stderr with these words in them, no new file.
    void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& words) {
        const auto before = files_in(folder.path);
        const RunResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 2) << result.err;
        EXPECT_THAT(result.out, IsEmpty());
        const auto lines = std::count(result.err.begin(), result.err.end(), '\n');
        EXPECT_TRUE(lines == 1 || lines == 2) << result.err;
        for (const std::string& word : words) EXPECT_THAT(result.err, HasSubstr(word));
        EXPECT_EQ(files_in(folder.path), before) << "nothing may be left behind";
    }

    const TemporaryFolder folder;
    const std::string scene = write_small_scene(folder.path).filename().string();
};

TEST_F(Pathtracer, TellsItsVersionAndHelp) {
    EXPECT_EQ(run({"--version"}).exit_code, 0);
    EXPECT_THAT(run({"--version"}).out, HasSubstr("pathtracer "));
    const RunResult help = run({"render", "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.out, HasSubstr("--max-path-length"));
    EXPECT_THAT(help.err, IsEmpty());
}

TEST_F(Pathtracer, LoadsOpenImageIoToReadWhatIsNoPngAndSaysWhereItIsMissing) {
    const RunResult libraries = run_program({"ldd", PATHTRACER}, folder.path);
    EXPECT_THAT(libraries.out, HasSubstr("libc.so"));
    for (const char* of_a_module : {"OpenImageIO", "libembree", "libvulkan"})
        EXPECT_THAT(libraries.out, Not(HasSubstr(of_a_module)));
    EXPECT_LT(std::count(libraries.out.begin(), libraries.out.end(), '\n'), 60);  // it alone has 250

    // The program alone, without its modules.
    std::filesystem::create_directory(folder.path / "bin");
    std::filesystem::copy(PATHTRACER, folder.path / "bin" / "pathtracer");
    const std::string alone = (folder.path / "bin" / "pathtracer").string();
    EXPECT_EQ(run_program({alone, "--version"}, folder.path).exit_code, 0);
    EXPECT_EQ(run_program({alone, "render", scene, "--core", "null", "-o", "a.exr"}, folder.path).exit_code, 0);
    const RunResult refused =
        run_program({alone, "render", scene, "--core", "null", "-o", "a.png", "--sky", PARITY_SKY}, folder.path);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("pathtracer-images.so; install the program anew"));
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path / "a.png"));
}

TEST_F(Pathtracer, RefusesNonsenseInOneOrTwoLines) {
    expect_refused({}, {"no command"});
    expect_refused({"rendr", scene}, {"did you mean 'render'?"});
    expect_refused({"render"}, {"SCENE"});
    expect_refused({"render", scene, "--size", "0x0"}, {"--size", "640x360"});
    expect_refused({"render", scene, "--size", "100000x100000"}, {"--size", "32768"});
    expect_refused({"render", scene, "--spp", "0"}, {"--spp"});
    expect_refused({"render", scene, "--spp", "-3"}, {"--spp", "-3"});
    expect_refused({"render", scene, "-o", "a.jpg"}, {"a.jpg", ".png", ".exr"});
    expect_refused({"render", scene, "-o", "missing/a.png"}, {"missing/a.png", "no folder"});
    expect_refused({"render", scene, "-o", "."}, {"."});
    expect_refused({"render", scene, "--stats", "missing/a.json"}, {"missing/a.json"});
    expect_refused({"render", scene, "-o", "a.png", "--stats", "./a.png"}, {"--stats ./a.png", "a name of its own"});
    expect_refused({"render", scene, "--sky", "3e38,1,1"}, {"3e38,1,1", "1e+12"});
    expect_refused({"render", scene, "--kernels", "missing"}, {"--kernels", "missing"});
    expect_refused({"render", "missing.gltf"}, {"missing.gltf"});
    expect_refused({"render", scene, "--camera", "1"}, {"--camera", scene});
    expect_refused({"render", scene, "--camera", "missing.json"}, {"missing.json"});
    expect_refused({"render", scene, "--sky", "missing.hdr"}, {"missing.hdr"});
    expect_refused({"render", scene, "--aperture", "0.1"}, {"--aperture", "--focus"});
    expect_refused({"render", scene, "--aperture", "1e13", "--focus", "1"}, {"lens's radius", "1e+12"});
    expect_refused({"render", scene, "--aperture", "1e9", "--focus", "1", "--fov", "0.01"}, {"lens's radius", "1000"});
    expect_refused({"compare", scene, "--limit-ssim", "0.9", "--size", "10x10"}, {"--limit-ssim", "11"});
    expect_refused({"compare", scene, "-o", scene + "/dir"}, {scene + "/dir"});
}

TEST_F(Pathtracer, AnUnwritablePlaceIsFoundBeforeTheSceneIsRead) {
    expect_refused({"render", "missing.gltf", "-o", "missing/a.png"}, {"missing/a.png"});
}

TEST_F(Pathtracer, RendersToThePlaceAskedForAndKeepsStdoutEmpty) {
    const RunResult result = render({"-o", "a.png"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(result.err, HasSubstr("a.png: 16x9, 2 samples per pixel"));
    EXPECT_THAT(files_in(folder.path), ElementsAre("a.png", scene));
    EXPECT_EQ(read_file(folder.path / "a.png").substr(0, 4), "\x89PNG");
}

TEST_F(Pathtracer, RendersToTheScenesNameByDefault) {
    const RunResult result = render({});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("triangle.png: 16x9, 2 samples per pixel"));
    EXPECT_THAT(files_in(folder.path), ElementsAre(scene, "triangle.png"));
}

TEST_F(Pathtracer, RefusesSequencesThatAreNone) {
    const auto refused = [&](std::vector<std::string> more, const std::vector<std::string>& words) {
        more.insert(more.begin(), {"render", scene});
        expect_refused(more, words);
    };
    refused({"--frames", "3:3"}, {"--frames", "'3:3' holds no frames;", "3:4"});
    refused({"--frames", "3:1"}, {"--frames", "runs backwards"});
    refused({"--frames", "3"}, {"--frames", "A:B"});
    refused({"--frames", "0:2", "--fps", "0"}, {"--fps", "0"});
    refused({"--frames", "0:2", "-o", "a.png"}, {"a.png", "####"});
    refused({"--frames", "0:2", "--time", "1"}, {"--time"});
    refused({"--frames", "0:2", "--stats", "a.json"}, {"--stats"});
    refused({"--time", "inf"}, {"--time", "inf"});
}

TEST_F(Pathtracer, ASequenceIsTakenUpWhereItsFramesHaveTheseOptions) {
    const std::string moving = write_moving_scene(folder.path).filename().string();
    const std::vector<std::string> still = {"--look-at", "0,0,5,0,0,0", "--sky", "1,1,1", "-o", "f##.png"};
    const auto frames = [&](const std::string& range, std::vector<std::string> more = {}) {
        std::vector<std::string> words = {"render", moving, "--core", "null", "--size", "16x9", "--spp", "2"};
        words.insert(words.end(), still.begin(), still.end());
        words.insert(words.end(), {"--frames", range, "--fps", "2"});
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    const RunResult first = frames("0:2", {"--progress"});
    EXPECT_EQ(first.exit_code, 0) << first.err;
    EXPECT_THAT(first.out, IsEmpty());
    EXPECT_THAT(first.err, HasSubstr("frame 1 (2/2)"));
    EXPECT_THAT(first.err, HasSubstr("f00.png to f01.png: 2 frames of 16x9, 2 samples per pixel\n"));
    const std::string kept = read_file(folder.path / "f01.png");
    EXPECT_THAT(frames("0:3", {"--resume"}).err, HasSubstr("3 frames of 16x9, 2 samples per pixel, 2 of them kept"));
    EXPECT_THAT(frames("0:3", {"--resume", "--seed", "1"}).err, Not(HasSubstr("kept")));
    EXPECT_NE(read_file(folder.path / "f01.png"), kept);
    EXPECT_THAT(files_in(folder.path), ElementsAre("f00.png", "f01.png", "f02.png", moving, scene));
    // A disk that is full from here on, for what is said as well: what is there stays, and nothing unfinished does.
    const RunResult full = run_program({"sh",          "-c",      "trap '' XFSZ; ulimit -f 0; exec \"$0\" \"$@\"",
                                        PATHTRACER,    "render",  moving,
                                        "--core",      "null",    "--size",
                                        "16x9",        "--spp",   "2",
                                        "--seed",      "1",       "--look-at",
                                        "0,0,5,0,0,0", "--sky",   "1,1,1",
                                        "-o",          "f##.png", "--frames",
                                        "0:5",         "--fps",   "2",
                                        "--resume"},
                                       folder.path);
    EXPECT_EQ(full.exit_code, 2);
    EXPECT_THAT(files_in(folder.path), ElementsAre("f00.png", "f01.png", "f02.png", moving, scene));
}

TEST_F(Pathtracer, SaysWhichCameraAndSkyItTook) {
    const RunResult result = render({});
    EXPECT_THAT(result.err, HasSubstr("no camera in the scene: the view frames all of it, --look-at "));
    EXPECT_THAT(result.err, HasSubstr("neutral studio sky; --sky 0,0,0 leaves it black"));
    EXPECT_THAT(render({"--sky", "0,0,0"}).err, Not(HasSubstr("studio")));
    EXPECT_THAT(render({"--look-at", "0,0,5,0,0,0"}).err, Not(HasSubstr("--look-at")));
    EXPECT_THAT(render({"--quiet"}).err, IsEmpty());
}

TEST_F(Pathtracer, ShowsAProgressBarOnlyWhenAskedForHere) {
    EXPECT_THAT(render({}).err, Not(HasSubstr("samples")));
    EXPECT_THAT(render({"--progress"}).err, HasSubstr("1/2 samples"));
    EXPECT_THAT(render({"--progress", "--quiet"}).err, IsEmpty());
}

TEST_F(Pathtracer, ColoursOnlyWhereAskedFor) {
    EXPECT_THAT(run({"render", "missing.gltf"}).err, Not(HasSubstr("\033[")));
    EXPECT_THAT(run({"render", "missing.gltf", "--color", "always"}).err, HasSubstr("\033["));
    EXPECT_THAT(run({"render", "missing.gltf", "--color", "never"}).err, Not(HasSubstr("\033[")));
}

TEST_F(Pathtracer, WritesStatistics) {
    const RunResult result = render({"-o", "a.exr", "--stats", "s.json", "--seed", "5"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json stats = json::parse(read_file(folder.path / "s.json"));
    EXPECT_EQ(stats["core"], "null");
    EXPECT_EQ(stats["size"], json::array({16, 9}));
    EXPECT_EQ(stats["spp"], 2);
    EXPECT_EQ(stats["seed"], 5);
    EXPECT_EQ(stats["triangles"], 1);
    EXPECT_TRUE(stats["core_reason"].is_string());
}

TEST_F(Pathtracer, PrintsStatisticsAsJson) {
    const RunResult result = render({"--format", "json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(json::parse(result.out)["core"], "null");
}

TEST_F(Pathtracer, BenchesTheNullCore) {
    const RunResult result =
        run({"bench", scene, "--core", "null", "--size", "16x9", "--spp", "3", "--format", "json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json bench = json::parse(result.out);
    EXPECT_EQ(bench["frames"], 3);
    EXPECT_TRUE(bench["embree_limit_ms"].is_null());
    EXPECT_THAT(run({"bench", scene, "--core", "null", "-o", "b.txt"}).out, IsEmpty());
    EXPECT_THAT(read_file(folder.path / "b.txt"), HasSubstr("null core"));
}

TEST_F(Pathtracer, TellsThatTheResultCouldNotBeWritten) {
    for (const char* line : {" info -o /dev/full", " info > /dev/full", " --help > /dev/full"}) {
        const RunResult result = run_program({"sh", "-c", PATHTRACER + std::string(line)}, folder.path);
        EXPECT_EQ(result.exit_code, 2) << line;
        EXPECT_THAT(result.err, HasSubstr("cannot write")) << line;
    }
}

TEST_F(Pathtracer, InfoListsBothCoresWithOrWithoutADevice) {
    const RunResult result =
        run({"info", "--format", "json"}, {"VK_DRIVER_FILES=/nowhere", "VK_ICD_FILENAMES=/nowhere"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json info = json::parse(result.out);
    ASSERT_EQ(info["cores"].size(), 2u);
    EXPECT_EQ(info["cores"][0]["id"], "source");
    EXPECT_EQ(info["cores"][0]["available"], false);
    EXPECT_TRUE(info["cores"][0]["reason"].is_string());
    EXPECT_EQ(info["cores"][1]["id"], "target");
}

}  // namespace
}  // namespace pathtracer_cli_test
