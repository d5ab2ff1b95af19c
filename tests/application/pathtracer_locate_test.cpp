// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
//
// compare --locate on kernels with one edit, whose kernel is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/application/run_pathtracer.h"
#include "tests/application/skip_without_core.h"
#include "tests/application/small_scene.h"

namespace pathtracer_locate_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

class Locate : public testing::Test {
protected:
    RunResult run(const std::string& scene, const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"compare", scene,      "--size",   "48x27", "--spp",
                                              "2",       "--locate", "--format", "json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_pathtracer(arguments, folder.path);
    }

    /// A copy of the kernels in which `from`, which stands there once, is `to`.
    void edit_kernel(const std::string& file, const std::string& from, const std::string& to) {
        std::filesystem::remove_all(folder.path / "kernels");
        std::filesystem::copy(SOURCE_KERNELS, folder.path / "kernels");
        std::string text = read_file(folder.path / "kernels" / file);
        const size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << file << ": " << from;
        ASSERT_EQ(text.find(from, at + 1), std::string::npos) << file << ": " << from;
        std::ofstream(folder.path / "kernels" / file, std::ios::binary) << text.replace(at, from.size(), to);
    }

    static std::map<std::string, std::string> prints(const json& evidence) {
        std::map<std::string, std::string> prints;
        for (const json& text : evidence["texts"]) prints[text["file"]] = text["fingerprint"];
        return prints;
    }

    const TemporaryFolder folder;
};

#define SKIP_WITHOUT_CORES() \
    SKIP_WITHOUT("source");  \
    SKIP_WITHOUT("target")

TEST_F(Locate, NamesTheKernelOfAnEdit) {
    SKIP_WITHOUT_CORES();
    struct Edit {
        std::string file, from, to, kernel, field;
    };
    const std::vector<Edit> edits = {
        {"generate.glsl", "Float(row) + jitter.y", "Float(row) + jitter.x", "generate", "ray_direction"},
        {"extend.glsl", "trace_closest(path_ray.ray, path)",
         "trace_closest(path_ray.ray, path + 1u); hit.instance += 1u", "extend", "hit"},
        {"shade.glsl", "light.distance * 0.9999f", "light.distance * 0.5f", "shade", "shadow_distance"},
        {"connect.glsl", "radiance, !blocked", "radiance, blocked", "connect", "radiance"},
        {"finalize.glsl", "sum * pass.sample_scale", "sum", "finalize", "pixel"}};
    for (const Edit& edit : edits) {
        SCOPED_TRACE(edit.file + ": " + edit.to);
        edit_kernel(edit.file, edit.from, edit.to);
        const RunResult result = run("still_life", {"--exact", "--kernels", "kernels"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        const json located = json::parse(result.out)["locate"];
        const json& first = located["first"];
        ASSERT_TRUE(first.is_object()) << located;
        EXPECT_EQ(first["kernel"], edit.kernel) << located;
        EXPECT_EQ(first["field"], edit.field) << located;
        EXPECT_EQ(located["differences"].size(), 1u) << located;
        EXPECT_GT(first["share"], 0.1);
        EXPECT_EQ(located["mode"], "exact");
    }
}

TEST_F(Locate, FindsNothingBetweenTwinsAndWritesEvidenceOfTheTextsThatRan) {
    SKIP_WITHOUT_CORES();
    const RunResult twins = run("still_life", {"--exact", "--evidence", "e.json"});
    ASSERT_EQ(twins.exit_code, 0) << twins.err;
    const json located = json::parse(twins.out)["locate"];
    EXPECT_EQ(located["first"], nullptr);
    EXPECT_EQ(located["explained_by_ties"], 0);
    const json evidence = json::parse(read_file(folder.path / "e.json"));
    EXPECT_EQ(evidence["version"], 1);
    EXPECT_EQ(evidence["kind"], "locate");
    EXPECT_EQ(evidence["first"], nullptr);
    EXPECT_EQ(evidence["differences"], json::array());
    EXPECT_EQ(evidence["pictures"], json::array());
    EXPECT_EQ(evidence["ssim"], 1.0);
    EXPECT_EQ(evidence["kernels"].size(), 5u);
    const auto plain = prints(evidence);
    EXPECT_TRUE(plain.contains("source_core/kernels/bsdf.glsl"));
    EXPECT_TRUE(plain.contains("target_core/kernels/bsdf.h"));

    edit_kernel("connect.glsl", "radiance, !blocked", "radiance, blocked");
    ASSERT_EQ(run("still_life", {"--exact", "--kernels", "kernels", "-o", "out/pictures", "--evidence", "out/e.json"})
                  .exit_code,
              2)
        << "its folder is not there";
    EXPECT_FALSE(std::filesystem::exists(folder.path / "out"));
    ASSERT_EQ(run("still_life", {"--exact", "-o", "made/", "--evidence", "made/e.json"}).exit_code, 0)
        << "it is made for the pictures";
    EXPECT_FALSE(json::parse(read_file(folder.path / "made" / "e.json"))["pictures"].empty());
    std::filesystem::create_directory(folder.path / "out");
    const RunResult result =
        run("still_life", {"--exact", "--kernels", "kernels", "-o", "out/pictures", "--evidence", "out/e.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json seen = json::parse(read_file(folder.path / "out" / "e.json"));
    EXPECT_EQ(seen["first"], json::parse(result.out)["locate"]["first"]);
    EXPECT_LT(seen["ssim"], 1.0);
    for (const json& picture : seen["pictures"])
        EXPECT_TRUE(std::filesystem::exists(folder.path / "out" / picture.get<std::string>())) << picture;
    EXPECT_EQ(seen["pictures"][0], "pictures/located.png");

    auto edited = prints(seen);
    EXPECT_NE(edited["source_core/kernels/connect.glsl"], plain.at("source_core/kernels/connect.glsl"));
    edited["source_core/kernels/connect.glsl"] = plain.at("source_core/kernels/connect.glsl");
    EXPECT_EQ(edited, plain);
}

TEST_F(Locate, WorksWhereNothingIsHit) {
    SKIP_WITHOUT_CORES();
    const std::string scene = write_small_scene(folder.path).string();
    const std::vector<std::string> away = {"--look-at", "0,0,3,0,0,9", "--sky", "1,1,1", "--evidence", "e.json"};
    const RunResult result = run(scene, away);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json located = json::parse(result.out)["locate"];
    EXPECT_EQ(located["first"], nullptr);
    EXPECT_EQ(located["mode"], "native");
    constexpr int paths = 48 * 27 * 2;
    EXPECT_EQ(located["compared"],
              json({{"generate", paths}, {"extend", paths}, {"shade", 0}, {"connect", 0}, {"finalize", paths}}));
    const json evidence = json::parse(read_file(folder.path / "e.json"));
    std::vector<std::string> ran;
    for (const json& kernel : evidence["kernels"]) ran.push_back(kernel["kernel"]);
    EXPECT_EQ(ran, (std::vector<std::string>{"generate", "extend", "finalize"}));

    // An edit of a kernel that no path runs through is not taken for one that changes nothing.
    edit_kernel("connect.glsl", "radiance, !blocked", "radiance, blocked");
    std::vector<std::string> text = away;
    text.insert(text.end(), {"--kernels", "kernels", "--format", "text"});
    const RunResult told = run(scene, text);
    ASSERT_EQ(told.exit_code, 0) << told.err;
    EXPECT_THAT(told.out, HasSubstr("none part; none ran through shade, connect"));
}

TEST_F(Locate, RefusesEvidenceOfNothing) {
    const RunResult result = run_pathtracer({"compare", "still_life", "--evidence", "e.json"}, folder.path);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("--locate"));
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(files_in(folder.path), IsEmpty());
}

}  // namespace
}  // namespace pathtracer_locate_test
