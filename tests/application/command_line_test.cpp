// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "application/command_table.h"

namespace command_line_test {
namespace {

using namespace application;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Invocation parse(const std::string& line) {
    std::istringstream stream(line);
    const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
    return parse_command_line(words);
}

TEST(CommandLine, ASceneAloneTakesEveryDefault) {
    const Invocation invocation = parse("render a.gltf");
    ASSERT_NE(invocation.command, nullptr);
    EXPECT_EQ(invocation.command->name, "render");
    const Options& options = invocation.options;
    EXPECT_EQ(options.scene, "a.gltf");
    EXPECT_EQ(options.output, "");
    EXPECT_THAT(options.cores, ElementsAre("auto"));
    EXPECT_EQ(options.width, 640u);
    EXPECT_EQ(options.height, 360u);
    EXPECT_THAT(options.spp, ElementsAre(16u));
    EXPECT_EQ(options.seed, 0u);
    EXPECT_EQ(options.max_path_length, 8u);
    EXPECT_TRUE(options.russian_roulette);
    EXPECT_TRUE(options.next_event_estimation);
    EXPECT_FALSE(options.exact);
    EXPECT_FALSE(options.allow_outside);
    EXPECT_TRUE(options.variant.empty());
    EXPECT_EQ(options.threads, 0u);
    EXPECT_EQ(options.gpu_memory_limit, 0u);
    EXPECT_EQ(options.format, Format::text);
    EXPECT_FALSE(options.core_given);
}

TEST(CommandLine, EveryOptionOfTheContractIsTaken) {
    const Options options =
        parse(
            "render a.glb -o b.exr --core target --size 320x180 --spp 4 --seed 7 --max-path-length 3 --no-roulette "
            "--no-nee --exact --allow-outside --variant beach --camera 2 --sky 1,2,3 --threads 5 --gpu-memory-limit 64 "
            "--kernels dir "
            "--stats s.json "
            "--format json --quiet --color never --progress")
            .options;
    EXPECT_EQ(options.output, "b.exr");
    EXPECT_THAT(options.cores, ElementsAre("target"));
    EXPECT_TRUE(options.core_given);
    EXPECT_EQ(options.width, 320u);
    EXPECT_EQ(options.height, 180u);
    EXPECT_THAT(options.spp, ElementsAre(4u));
    EXPECT_EQ(options.seed, 7u);
    EXPECT_EQ(options.max_path_length, 3u);
    EXPECT_FALSE(options.russian_roulette);
    EXPECT_FALSE(options.next_event_estimation);
    EXPECT_TRUE(options.exact);
    EXPECT_TRUE(options.allow_outside);
    EXPECT_EQ(options.variant, "beach");
    EXPECT_EQ(options.camera.index, 2u);
    EXPECT_THAT(*options.sky.radiance, ElementsAre(1.0f, 2.0f, 3.0f));
    EXPECT_EQ(options.threads, 5u);
    EXPECT_EQ(options.gpu_memory_limit, uint64_t{64} << 20);
    EXPECT_EQ(options.kernels, "dir");
    EXPECT_EQ(options.stats, "s.json");
    EXPECT_EQ(options.format, Format::json);
    EXPECT_TRUE(options.quiet);
    EXPECT_TRUE(options.progress);
    EXPECT_EQ(options.color, ColorMode::never);
}

TEST(CommandLine, CommonOptionsMayComeBeforeTheCommand) {
    const Invocation invocation = parse("--color always --quiet render a.gltf");
    ASSERT_NE(invocation.command, nullptr);
    EXPECT_EQ(invocation.options.color, ColorMode::always);
    EXPECT_TRUE(invocation.options.quiet);
}

TEST(CommandLine, CompareTakesSeveralSampleCountsAndALimit) {
    const Options options = parse("compare a.gltf --spp 1,4,16 --limit-ssim 0.99 -o dir").options;
    EXPECT_THAT(options.spp, ElementsAre(1u, 4u, 16u));
    EXPECT_EQ(options.limit_ssim, 0.99);
    EXPECT_EQ(options.output, "dir");
    EXPECT_EQ(parse("render a.gltf --spp 1,4").exit_code, FAILED);
}

TEST(CommandLine, TheLastOfARepeatedOptionCounts) {
    EXPECT_EQ(parse("render a.gltf --seed 1 --seed 2").options.seed, 2u);
}

TEST(CommandLine, AnEmptyNameIsRefused) {
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"render", ""},
             {"render", "a.gltf", "-o", ""},
             {"render", "a.gltf", "--stats", ""},
             {"bench", "a.gltf", "--kernels", ""},
             {"info", "--output="},
         }) {
        const Invocation invocation = parse_command_line(words);
        EXPECT_EQ(invocation.exit_code, FAILED) << words.back();
        EXPECT_EQ(invocation.command, nullptr);
    }
}

struct Refusal {
    std::string line;
    std::string says;
};

TEST(CommandLine, RefusalsNameTheThingAndExitWithTwo) {
    const std::vector<Refusal> refusals = {
        {"", "no command given"},
        {"rendr a.gltf", "unknown command 'rendr'; did you mean 'render'?"},
        {"watch a.gltf", "unknown command 'watch'; there are render, compare, view, merge, bench, info"},
        {"--quiet comapre a", "did you mean 'compare'?"},
        {"render", "SCENE"},
        {"render a.gltf b.gltf", "unexpected argument 'b.gltf'"},
        {"render a.gltf --sze 1x1", "unknown option '--sze'; did you mean '--size'?"},
        {"render a.gltf --sze=1x1", "did you mean '--size'?"},
        {"render a.gltf -x", "unknown option '-x'"},
        {"render a.gltf --size 0x0", "--size: '0x0'"},
        {"render a.gltf --size", "--size"},
        {"render a.gltf --spp 0", "--spp: '0' is not a whole number from 1 to 16777216"},
        {"render a.gltf --spp -1", "--spp: '-1'"},
        {"render a.gltf --seed -1", "--seed: '-1'"},
        {"render a.gltf --spp=1e3", "--spp: '1e3'"},
        {"render a.gltf --core gpu", "--core: 'gpu' is not one of auto, null, source, target"},
        {"render a.gltf --core target,gpu", "--core: 'gpu' is not one of auto, null, source, target"},
        {"render a.gltf --core target,auto", "--core: 'auto' is not one of auto, null, source, target"},
        {"render a.gltf --core target,target", "names target twice"},
        {"render a.gltf --threads 0", "--threads: '0'"},
        {"render a.gltf --max-path-length 0", "--max-path-length: '0'"},
        {"render a.gltf --gpu-memory-limit lots", "--gpu-memory-limit: 'lots'"},
        {"render a.gltf --sky blue", "--sky: 'blue'"},
        {"render a.gltf --format yaml", "--format: 'yaml' is not one of json, text"},
        {"render a.gltf --color pink", "--color: 'pink'"},
        {"render a.gltf --quiet --verbose", "--quiet and --verbose"},
        {"compare a.gltf --limit-ssim 2", "--limit-ssim: '2'"},
        {"compare a.gltf --spp 1,x", "--spp: 'x'"},
        {"info a.gltf", "unexpected argument 'a.gltf'"},
    };
    for (const Refusal& refusal : refusals) {
        SCOPED_TRACE(refusal.line);
        const Invocation invocation = parse(refusal.line);
        EXPECT_EQ(invocation.command, nullptr);
        EXPECT_EQ(invocation.exit_code, FAILED);
        EXPECT_THAT(invocation.text, HasSubstr(refusal.says));
        EXPECT_LE(std::count(invocation.text.begin(), invocation.text.end(), '\n'), 2);
        EXPECT_THAT(invocation.text, HasSubstr("--help"));
    }
}

TEST(CommandLine, HelpOfEachCommandNamesItsOptions) {
    for (const Command& command : command_table()) {
        const Invocation invocation = parse(command.name + " --help");
        EXPECT_EQ(invocation.command, nullptr);
        EXPECT_EQ(invocation.exit_code, DONE);
        EXPECT_THAT(invocation.text, HasSubstr("pathtracer " + command.name));
        const bool prints = command.name != "view";
        EXPECT_THAT(invocation.text, HasSubstr(prints ? "--format" : "--log"));
        EXPECT_THAT(invocation.text, HasSubstr("--quiet"));
    }
    EXPECT_THAT(parse("render -h").text, HasSubstr("--max-path-length"));
    EXPECT_THAT(parse("render -h").text, Not(HasSubstr("--limit-ssim")));
    EXPECT_THAT(parse("compare --help").text, HasSubstr("--limit-ssim"));
    EXPECT_THAT(parse("view --help").text, HasSubstr("--log"));
    EXPECT_EQ(parse("view a.gltf").options.spp, std::vector<uint32_t>{4096});
    EXPECT_EQ(parse("view a.gltf --spp 8").options.spp, std::vector<uint32_t>{8});
}

TEST(CommandLine, HelpAndVersionOfTheProgram) {
    const Invocation help = parse("--help");
    EXPECT_EQ(help.exit_code, DONE);
    for (const Command& command : command_table()) EXPECT_THAT(help.text, HasSubstr(command.help));
    for (const char* line : {"--version", "render --version", "info --version"}) {
        EXPECT_THAT(parse(line).text, testing::MatchesRegex("pathtracer [0-9]+\\.[0-9]+\\.[0-9]+\n")) << line;
        EXPECT_EQ(parse(line).exit_code, DONE);
    }
}

}  // namespace
}  // namespace command_line_test
