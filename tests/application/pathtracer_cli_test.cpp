// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
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

/// Of many tries the quickest: other work on the machine makes none quicker.
TEST_F(Pathtracer, TellsItsVersionWithin30Milliseconds) {
    double least = 1e9;
    for (int i = 0; i < 200 && least >= 30.0; ++i) {
        const auto start = std::chrono::steady_clock::now();
        run({"--version"});
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        least = std::min(least, taken.count());
    }
    EXPECT_LT(least, 30.0);
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
    expect_refused({"render", scene, "--camera", "-1"}, {"--camera", "'-1'", "counted from 0"});
    expect_refused({"compare", scene, "-o", "new/dir", "--stats", "new/dir"}, {"a name of its own"});
    expect_refused({"compare", "--bias", "a.exr", "--"}, {"--: no image files behind it", "--bias A... -- B..."});
    expect_refused({"render", scene, "--focus", "5"}, {"--focus", "--aperture"});
    expect_refused({"render", scene, "-o", "f_####.png"}, {"f_####.png", "--frames A:B"});
    std::filesystem::create_directory(folder.path / "maps");
    expect_refused({"render", scene, "--kernels", "maps", "--core", "null", "--quiet"}, {"--kernels", "--core source"});
    expect_refused({"render", scene, "--sky", "maps"}, {"maps: is not a regular file but a folder"});
    expect_refused({"merge", "maps", "-o", "m.exr"}, {"maps: is not a regular file but a folder"});
}

TEST_F(Pathtracer, ReplacesNothingThatItReads) {
    const auto write = [&](const std::string& name, const std::string& text) {
        std::ofstream(folder.path / name, std::ios::binary) << text;
    };
    ASSERT_EQ(render({"-o", "floor1.png"}).exit_code, 0);
    ASSERT_EQ(render({"-o", "sky.exr"}).exit_code, 0);
    json textured = json::parse(read_file(folder.path / scene));
    textured["images"] = {{{"uri", "floor1.png"}}};
    textured["buffers"][0]["uri"] = "corners.bin";
    write("textured.gltf", textured.dump());
    constexpr std::array<float, 9> CORNERS = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
    write("corners.bin", std::string(reinterpret_cast<const char*>(CORNERS.data()), sizeof(CORNERS)));
    write("t.obj", "mtllib t.mtl\nusemtl m\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n");
    write("t.mtl", "newmtl m\nKd 1 1 1\n");
    write("cam.json", R"({"position": [0, 0, 5], "target": [0, 0, 0], "up": [0, 1, 0], "vfov_degrees": 40})");
    std::filesystem::create_hard_link(folder.path / "floor1.png", folder.path / "hard.png");
    std::filesystem::create_symlink("floor1.png", folder.path / "link.png");
    std::filesystem::create_directory(folder.path / "cd");
    for (const char* name : {"cd/b.png", "cd/difference.png"})
        std::filesystem::copy(folder.path / "floor1.png", folder.path / name);
    std::map<std::string, std::string> before;
    for (const std::string& name : files_in(folder.path)) before[name] = read_file(folder.path / name);

    const std::string by_scene = ": the scene reads this file; give another name";
    const std::vector<std::string> null = {"--core", "null", "--size", "16x9", "--spp", "1"};
    const std::vector<std::pair<std::vector<std::string>, std::string>> rows = {
        {{"render", "textured.gltf", "-o", "floor1.png"}, "-o floor1.png" + by_scene},
        {{"render", "textured.gltf", "-o", "./hard.png"}, "-o ./hard.png" + by_scene},
        {{"render", "textured.gltf", "-o", "link.png"}, "-o link.png" + by_scene},
        {{"render", "textured.gltf", "-o", "floor#.png", "--frames", "0:3"}, "-o floor1.png" + by_scene},
        {{"render", "textured.gltf", "-o", "a.png", "--stats", "textured.gltf"}, "--stats textured.gltf" + by_scene},
        {{"render", "textured.gltf", "-o", "a.png", "--stats", "corners.bin"}, "--stats corners.bin" + by_scene},
        {{"render", "t.obj", "-o", "a.png", "--stats", "t.mtl"}, "--stats t.mtl" + by_scene},
        {{"render", "t.obj", "-o", "a.png", "--stats", "t.obj"}, "--stats t.obj" + by_scene},
        {{"render", scene, "--sky", "sky.exr", "-o", "sky.exr"}, "-o sky.exr: --sky reads this file"},
        {{"render", scene, "--camera", "cam.json", "-o", "a.png", "--stats", "cam.json"}, "--camera reads this file"},
        {{"bench", scene, "-o", scene}, "-o " + scene + by_scene},
        {{"merge", "sky.exr", "-o", "sky.exr"}, "-o sky.exr: merge reads this file"},
        {{"compare", "cd/difference.png", "floor1.png", "-o", "cd"}, "-o cd/difference.png: compare reads this file"},
    };
    for (auto [words, said] : rows) {
        if (words[0] == "render") words.insert(words.end(), null.begin(), null.end());
        expect_refused(words, {said});
    }
    for (const auto& [name, content] : before) EXPECT_TRUE(read_file(folder.path / name) == content) << name;
    EXPECT_THAT(files_in(folder.path / "cd"), ElementsAre("b.png", "difference.png"));
    EXPECT_THAT(render({"--camera", "cam.json", "--look-at", "0,0,9,0,0,0"}).err,
                HasSubstr("--look-at has the view; of cam.json"));
}

TEST_F(Pathtracer, RefusesAPipeThatNobodyReadsAndWritesToOneThatIsRead) {
    for (const char* name : {"pipe.png", "pipe1.png"}) ASSERT_EQ(mkfifo((folder.path / name).c_str(), 0600), 0);
    const std::string said = "it is a pipe that nobody reads from; give another place";
    expect_refused({"render", scene, "--core", "null", "-o", "pipe.png"}, {"cannot write pipe.png", said});
    expect_refused({"render", scene, "--core", "null", "-o", "a.png", "--stats", "pipe.png"}, {said});
    expect_refused({"render", scene, "--core", "null", "-o", "pipe#.png", "--frames", "0:2"}, {"pipe1.png", said});
    expect_refused({"merge", "pipe.png", "-o", "m.exr"}, {"pipe.png: is not a regular file but a pipe"});
    ASSERT_EQ(render({"-o", "a.png"}).exit_code, 0);
    const RunResult piped =
        run_program({"sh", "-c", "exec 3<>pipe.png; \"$0\" \"$@\" && dd bs=65536 count=1 <&3 >got.png", PATHTRACER,
                     "render", scene, "--core", "null", "--size", "16x9", "--spp", "2", "-o", "pipe.png"},
                    folder.path);
    EXPECT_EQ(piped.exit_code, 0) << piped.err;
    EXPECT_TRUE(read_file(folder.path / "got.png") == read_file(folder.path / "a.png"));
    // A device takes no statistics: what was written before is said.
    const RunResult full = render({"-o", "q.png", "--stats", "/dev/full"});
    EXPECT_EQ(full.exit_code, 2);
    EXPECT_THAT(full.err, HasSubstr("what -o names is written: q.png"));
    EXPECT_TRUE(std::filesystem::exists(folder.path / "q.png"));
}

TEST_F(Pathtracer, AFolderDoesNotHideABuiltInScene) {
    std::filesystem::create_directory(folder.path / "still_life");
    const RunResult result = run({"render", "still_life", "--core", "null", "--size", "16x9", "--spp", "1"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("still_life.png: 16x9"));
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

TEST_F(Pathtracer, FramesAreRenderedAgainWhereWhatTheySeeHasChanged) {
    const std::filesystem::path file = write_moving_scene(folder.path);
    std::string text = read_file(file);
    const size_t uri = text.find("data:");
    text.replace(uri, text.find('"', uri) - uri, "moving.bin");
    std::ofstream(file) << text;
    const auto write_buffer = [&](float last_x) {
        const float corners_times_places[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, last_x, 0, 0};
        std::ofstream(folder.path / "moving.bin", std::ios::binary)
            .write(reinterpret_cast<const char*>(corners_times_places), sizeof(corners_times_places));
    };
    const auto frames = [&](std::vector<std::string> more = {}) {
        std::vector<std::string> words = {
            "render",    "moving.gltf", "--core", "null",   "--size",   "16x9", "--spp", "2",
            "--look-at", "0,0,5,0,0,0", "-o",     "f#.png", "--frames", "0:3",  "--fps", "2"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    write_buffer(1);
    EXPECT_EQ(frames().exit_code, 0);
    std::ofstream(file) << text << "\n\n";  // says the same
    EXPECT_THAT(frames({"--resume"}).err, HasSubstr(", 3 of them kept"));
    write_buffer(2);  // goes on elsewhere from where it starts
    EXPECT_THAT(frames({"--resume"}).err, HasSubstr(", 1 of them kept"));
    EXPECT_THAT(frames({"--resume", "--fov", "30"}).err, Not(HasSubstr("kept")));
}

TEST_F(Pathtracer, OnlyFramesThatAreWholeAreKept) {
    const auto frames = [&](const std::string& pattern, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"-o", pattern, "--frames", "0:4", "--look-at", "0,0,5,0,0,0", "--sky", "1,1,1"});
        return render(more);
    };
    for (const std::string ending : {".png", ".exr"}) {
        const std::string pattern = "f#" + ending;
        EXPECT_EQ(frames(pattern).exit_code, 0);
        std::vector<std::string> whole;
        for (int i = 0; i < 4; ++i) whole.push_back(read_file(folder.path / ("f" + std::to_string(i) + ending)));
        // Cut off within the pixels; behind them (of an EXR still within); a bit of a pixel the other way.
        std::vector<std::string> torn = {whole[0].substr(0, whole[0].size() / 2),
                                         whole[1].substr(0, whole[1].size() - 5), whole[2], whole[3]};
        const size_t pixel = ending == ".png" ? whole[2].find("IDAT") + 8 : whole[2].size() - 3;
        torn[2][pixel] = static_cast<char>(torn[2][pixel] ^ 4);
        for (int i = 0; i < 4; ++i)
            std::ofstream(folder.path / ("f" + std::to_string(i) + ending), std::ios::binary)
                << torn[static_cast<size_t>(i)];
        EXPECT_THAT(frames(pattern, {"--resume"}).err, HasSubstr(", 1 of them kept"));
        for (int i = 0; i < 4; ++i)
            EXPECT_TRUE(read_file(folder.path / ("f" + std::to_string(i) + ending)) == whole[static_cast<size_t>(i)])
                << i;
    }
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
