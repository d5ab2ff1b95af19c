// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// check --spirv: an edit that does not reach the compiled code is a note; the oracle is what the edit means in GLSL.
#include "porttool/spirv/spirv.h"

#include <algorithm>

#include "porttool/read/map_file.h"
#include "porttool/spirv/compile_limit.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::spirv_test {
namespace {

const char* kMath = R"(
#ifndef MATH
#define MATH
const float EPSILON_OF_PDF = 1e-6;
float weight(float value, float pdf) {
    float bounded = max(pdf, EPSILON_OF_PDF);
    if (value < 0.0) { return 0.0; }
    return value * 2.0 / bounded;
}
float never_called(float a) { return a * 3.0 + 1.0; }
#ifdef NEVER_DEFINED
float left_out(float a) { return a * 5.0 + 1.0; }
#endif
float branched(float a) {
#ifdef NEVER_DEFINED
    a = a * 7.0;
#endif
    return a + 4.0;
}
#endif
)";
const char* kEntry = R"(#version 450
#extension GL_GOOGLE_include_directive : require
#include "math.glsl"
layout(local_size_x = 8) in;
layout(std430, binding = 0) buffer Values { float values[]; };
void main() {
    uint job = gl_GlobalInvocationID.x;
    values[job] = weight(values[job], branched(0.5));
}
)";
const char* kPort = R"(
const float EPSILON_OF_PDF = 1e-6f;
float weight(float value, float pdf) {
    float bounded = max(pdf, EPSILON_OF_PDF);
    if (value < 0.0f) { return 0.0f; }
    return value * 2.0f / bounded;
}
float never_called(float a) { return a * 3.0f + 1.0f; }
float left_out(float a) { return a * 5.0f + 1.0f; }
float branched(float a) { return a + 4.0f; }
void shade_main(float* values, int job) { values[job] = weight(values[job], branched(0.5f)); }
)";

class Spirv : public ::testing::Test {
protected:
    void SetUp() override {
        if (!spirv_is_built_in()) GTEST_SKIP() << "this build has no glslang";
        disk.files = {{"/r/gpu/math.glsl", kMath}, {"/r/gpu/shade.comp", kEntry}, {"/r/cpu/shade.cpp", kPort}};
        record();
    }
    /// Pairs the functions by hand and records them as in step.
    void record() {
        ASSERT_EQ(run(disk, {"-C", "/r", "init", "--source", "gpu/*", "--target", "cpu/*", "--force"}).exit_code, 0);
        std::string map = "version = 1\n[sides]\nsource = [\"gpu/*\"]\ntarget = [\"cpu/*\"]\n";
        for (const std::string name : {"weight", "never_called", "left_out", "branched"})
            map += std::string("[[pair]]\nsource = \"gpu/math.glsl:") + name + "\"\ntarget = \"cpu/shade.cpp:" + name +
                   "\"\n";
        map += "[[pair]]\nsource = \"gpu/shade.comp:main\"\ntarget = \"cpu/shade.cpp:shade_main\"\n";
        if (disk.files["/r/gpu/math.glsl"].find("vec2 a") != std::string::npos)
            map += "[[pair]]\nsource = \"gpu/math.glsl:weight#2\"\ntarget = \"cpu/shade.cpp:weight#2\"\n";
        disk.files["/r/portmap.toml"] = map;
        ASSERT_EQ(run(disk, {"-C", "/r", "accept", "--all", "--force"}).exit_code, 0);
    }
    /// The report after one edit of a file.
    nlohmann::json after(const std::string& file, const std::string& from, const std::string& to) {
        const std::string path = "/r/gpu/" + file, before = disk.files[path];
        disk.files[path] = replaced(before, from, to);
        EXPECT_EQ(run(disk, {"-C", "/r", "check"}).exit_code, 1) << "without --spirv this is drift: " << to;
        last = run(disk, {"-C", "/r", "check", "--spirv", "--format", "json"});
        disk.files[path] = before;
        EXPECT_NE(last.exit_code, 2) << last.err;
        return last.exit_code == 2 ? nlohmann::json() : nlohmann::json::parse(last.out);
    }
    MemoryDisk disk;
    CommandRun last;
};

TEST_F(Spirv, AnEditThatDoesNotReachTheCodeIsANote) {
    const std::vector<std::pair<std::string, std::string>> edits = {
        {"float bounded =",
         "float unused = value * 17.0;\n    unused += value;\n    float bounded ="},  // an unused local
        {"return value * 2.0 / bounded;", "float old = bounded;\n    old += 3.0;\n    return value * 2.0 / bounded;"},
        {"value * 2.0 / bounded", "float(value) * 2.0 / bounded"},    // as what it is already
        {"value * 2.0 / bounded", "value * (1.0 + 1.0) / bounded"}};  // a constant expression
    for (const auto& [from, to] : edits) {
        const auto report = after("math.glsl", from, to);
        EXPECT_EQ(report["verdict"], "in_step") << to << "\n" << last.err << report.dump(1);
        ASSERT_EQ(report["findings"].size(), 1u) << to;
        EXPECT_EQ(report["findings"][0]["level"], "note");
        EXPECT_NE(report["findings"][0]["message"].get<std::string>().find("same SPIR-V as before (gpu/shade.comp)"),
                  std::string::npos)
            << report["findings"][0]["message"];
        EXPECT_EQ(report["summary"]["drifted"], 0);
        EXPECT_EQ(last.exit_code, 0);
        EXPECT_EQ(last.err, "");
    }
}

TEST_F(Spirv, AnEditThatChangesTheCodeStaysDrift) {
    const std::vector<std::pair<std::string, std::string>> edits = {
        {"value < 0.0", "value <= 0.0"},
        {"value * 2.0 / bounded", "value * (2.0 / bounded)"},  // another rounding
        {"max(pdf, EPSILON_OF_PDF)", "max(EPSILON_OF_PDF, pdf)"},
        {"if (value < 0.0) { return 0.0; }", ""},
        {"float bounded = max(pdf, EPSILON_OF_PDF);", "float bounded = max(value, EPSILON_OF_PDF);"},
        {"return value * 2.0 / bounded;", "bounded += 1.0;\n    return value * 2.0 / bounded;"},
        {"float weight(float value, float pdf)", "float weight(float pdf, float value)"}};
    for (const auto& [from, to] : edits) {
        const auto report = after("math.glsl", from, to);
        EXPECT_EQ(report["verdict"], "drift") << to << report.dump(1);
        EXPECT_EQ(last.exit_code, 1);
        EXPECT_EQ(last.err, "") << "it compiled, and differs";
    }
}

TEST_F(Spirv, AnEntryPointIsComparedToo) {
    EXPECT_EQ(
        after("shade.comp", "uint job = gl", "float spare = 1.0;\n    spare += 1.0;\n    uint job = gl")["verdict"],
        "in_step");
    EXPECT_EQ(after("shade.comp", "branched(0.5)", "branched(values[0])")["verdict"], "drift");
}

TEST_F(Spirv, WhatIsNotCompiledIsNotCalledTheSame) {
    // Nobody calls it: glslang leaves it out, and two modules without it prove nothing.
    EXPECT_EQ(after("math.glsl", "a * 3.0 + 1.0", "a * 3.0 - 1.0")["verdict"], "drift");
    EXPECT_EQ(
        after("math.glsl", "return a * 3.0", "float unused = 1.0;\n    unused += a;\n    return a * 3.0")["verdict"],
        "drift");
    EXPECT_EQ(after("math.glsl", "a * 5.0 + 1.0", "a * 5.0 - 1.0")["verdict"], "drift");
    EXPECT_NE(last.err.find("gpu/math.glsl:left_out keeps its level: no entry point calls it, or"), std::string::npos)
        << last.err;
    EXPECT_EQ(after("math.glsl", "a = a * 7.0", "a = a / 7.0")["verdict"], "drift");
    EXPECT_NE(last.err.find("one branch only"), std::string::npos) << last.err;
}

TEST_F(Spirv, OverloadsAreToldApart) {
    disk.files["/r/gpu/math.glsl"] = "float weight(vec2 a) { return a.x * 3.0 + a.y; }\n" + std::string(kMath);
    disk.files["/r/cpu/shade.cpp"] = "float weight(vec2 a) { return a.x * 3.0f + a.y; }\n" + std::string(kPort);
    record();
    EXPECT_EQ(after("math.glsl", "a.x * 3.0 + a.y", "a.x * 3.0 - a.y")["verdict"], "drift");
    EXPECT_NE(last.err.find("no entry point calls it"), std::string::npos) << last.err;
}

TEST_F(Spirv, AKernelThatDoesNotCompileKeepsItsLevelAndSaysWhy) {
    EXPECT_EQ(after("math.glsl",
                    "float bounded =", "float unused = no_such_name;\n unused += value;\n float bounded =")["verdict"],
              "drift");
    EXPECT_NE(last.err.find("gpu/shade.comp does not compile: gpu/math.glsl:"), std::string::npos) << last.err;
    EXPECT_NE(last.err.find("no_such_name"), std::string::npos) << last.err;
    EXPECT_EQ(std::count(last.err.begin(), last.err.end(), '\n'), 1) << last.err;
    disk.files.erase("/r/gpu/shade.comp");
    disk.files["/r/gpu/spare.glsl"] = "int spare(int a) { return a; }\n";
    EXPECT_EQ(
        after("math.glsl", "float bounded =", "float unused = 1.0;\n unused += value;\n float bounded =")["verdict"],
        "drift");
    EXPECT_NE(last.err.find("no entry point"), std::string::npos) << last.err;
}

TEST_F(Spirv, EveryEntryPointAndEveryPreambleMustAgree) {
    const std::string edit = "#ifdef SECOND\n#define SCALE 2.0\n#else\n#define SCALE 1.0\n#endif\n";
    disk.files["/r/gpu/math.glsl"] = edit + std::string(kMath);
    record();
    // SCALE is 1.0 without a preamble, and then the folded constant is the same.
    EXPECT_EQ(after("math.glsl", "value * 2.0 /", "value * (2.0 * SCALE) /")["verdict"], "in_step") << last.err;
    disk.files["/r/portmap.toml"] += "\n[spirv]\npreamble = [\"\", \"#define SECOND\"]\n";
    EXPECT_EQ(after("math.glsl", "value * 2.0 /", "value * (2.0 * SCALE) /")["verdict"], "drift");
    disk.files["/r/gpu/broken.frag"] =
        "#version 450\n#extension GL_GOOGLE_include_directive : require\n"
        "#include \"math.glsl\"\nvoid main() { nonsense }\n";
    EXPECT_EQ(
        after("math.glsl", "float bounded =", "float unused = 1.0;\n unused += value;\n float bounded =")["verdict"],
        "drift");
    EXPECT_NE(last.err.find("gpu/broken.frag does not compile"), std::string::npos) << last.err;
}

TEST_F(Spirv, IncludesAreFoundInTheFoldersOfTheMap) {
    disk.files["/r/shared/extra.glsl"] = "#define EXTRA 2.0\n";
    disk.files["/r/gpu/math.glsl"] = "#include <extra.glsl>\n" + replaced(kMath, "value * 2.0", "value * EXTRA");
    record();
    EXPECT_EQ(after("math.glsl", "value * EXTRA", "value * 2.0")["verdict"], "drift");
    EXPECT_NE(last.err.find("does not compile"), std::string::npos) << last.err;
    disk.files["/r/portmap.toml"] += "\n[spirv]\ninclude = [\"shared\"]\n";
    EXPECT_EQ(after("math.glsl", "value * EXTRA", "value * 2.0")["verdict"], "in_step") << last.err;
}

TEST_F(Spirv, AnIncludeThatLeadsOutOfTheRootIsNotRead) {
    disk.files["/outside/extra.glsl"] = "#define EXTRA 2.0\n";
    for (const std::string path :
         {"/outside/extra.glsl", "../../outside/extra.glsl", "../.git/../../outside/extra.glsl"}) {
        disk.files["/r/gpu/math.glsl"] =
            "#include \"" + path + "\"\n" + replaced(kMath, "value * 2.0", "value * EXTRA");
        record();
        EXPECT_EQ(after("math.glsl", "value * EXTRA", "value * 2.0")["verdict"], "drift") << path;
        EXPECT_NE(last.err.find("does not compile"), std::string::npos) << last.err;
    }
}

/// Where there is no glslang the option is refused with what to install, and nothing is printed as a result.
TEST(SpirvOption, WithoutGlslangNamesTheRemedy) {
    if (spirv_is_built_in()) GTEST_SKIP() << "this build has glslang";
    MemoryDisk disk;
    disk.files = {{"/r/src/k.glsl", "float f(float x) { return x + 1.0; }\n"},
                  {"/r/port/k.cpp", "float f(float x) { return x + 1.0f; }\n"}};
    run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"});
    EXPECT_EQ(run(disk, {"-C", "/r", "check"}).exit_code, 0);
    const CommandRun got = run(disk, {"-C", "/r", "check", "--spirv"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_EQ(got.out, "");
    EXPECT_NE(got.err.find("glslang-dev"), std::string::npos) << got.err;
}

TEST(ShaderFiles, StagesAndIncludes) {
    EXPECT_EQ(stage_of_path("a/b.comp"), ShaderStage::Compute);
    EXPECT_EQ(stage_of_path("a/b.rchit.glsl"), ShaderStage::ClosestHit);
    EXPECT_FALSE(stage_of_path("a/b.glsl"));
    EXPECT_FALSE(stage_of_path("comp"));
    std::map<std::string, std::string> files = {
        {"a/k.comp", "  #  include \"../b/x.h\"\n#include <y.h>\n// #include \"z.h\"\n"},
        {"b/x.h", "#include \"x.h\"\n#include \"z.h\"\n"},
        {"b/z.h", ""},
        {"i/y.h", ""}};
    const ShaderFiles get = [&](const std::string& path) { return files.contains(path) ? &files[path] : nullptr; };
    EXPECT_EQ(files_included(get, "a/k.comp", {"i"}), (std::set<std::string>{"a/k.comp", "b/x.h", "b/z.h", "i/y.h"}));
}

TEST(ShaderFiles, AFileThatIncludesItselfEnds) {
    if (!spirv_is_built_in()) GTEST_SKIP() << "this build has no glslang";
    const std::string text = "#version 450\n#include \"k.comp\"\nvoid main() {}\n";
    const ShaderFiles get = [&](const std::string& path) { return path == "k.comp" ? &text : nullptr; };
    EXPECT_FALSE(compile_to_spirv(get, "k.comp", {}, "").error.empty());
}

/// Every kernel of this repository compiles with the settings of its own map.
TEST(OwnKernels, CompileForSpirv) {
    if (!spirv_is_built_in()) GTEST_SKIP() << "this build has no glslang";
    const std::filesystem::path root = REPOSITORY;
    const ReadMap map = read_map("portmap.toml", read_text(root / "portmap.toml"));
    ASSERT_EQ(map.error, "");
    ASSERT_FALSE(map.map.shaders.preamble.empty());
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(root / "source_core/kernels"))
        files["source_core/kernels/" + entry.path().filename().string()] = read_text(entry.path());
    const ShaderFiles get = [&](const std::string& path) { return files.contains(path) ? &files[path] : nullptr; };
    int kernels = 0, with_main = 0;
    for (const auto& [path, text] : files) {
        with_main += text.find("void main()") == std::string::npos ? 0 : 1;
        if (!stage_of_path(path)) continue;
        ++kernels;
        for (const std::string& preamble : map.map.shaders.preamble)
            EXPECT_EQ(compile_to_spirv(get, path, map.map.shaders.include, preamble).error, "") << path;
    }
    EXPECT_EQ(kernels, with_main);
    EXPECT_GT(kernels, 5);
}

/// Forty lines that ask for 2^39 times nothing.
std::string endless_shader() {
    std::string out = "#version 450\n#define A0\n";
    for (int i = 1; i < 40; ++i) {
        const std::string last = " A" + std::to_string(i - 1);
        out += "#define A" + std::to_string(i) + last + last + "\n";
    }
    return out + "layout(set = 0, binding = 0) buffer B { float v[]; };\nvoid main() { A39 v[0] = 1.0; }\n";
}

TEST(CompileLimit, EndsTheProcessWhereACompilerDoesNotEnd) {
    if (!spirv_is_built_in()) GTEST_SKIP() << "this build has no glslang";
    const std::string text = endless_shader();
    const ShaderFiles files = [&](const std::string&) { return &text; };
    const auto run = [&] {
        CompileLimit::most_time() = std::chrono::milliseconds(200);
        compile_to_spirv(files, "s/\x1b[2Jk.comp", {}, "");
    };
    EXPECT_EXIT(run(), ::testing::ExitedWithCode(2),
                "^porttool: --spirv: s/.u.1b.\\[2Jk.comp takes too much processor time");
}

TEST(CompileLimit, CountsTheTimeOfARunTogether) {
    const auto run = [] {
        CompileLimit::left_in_all() = std::chrono::milliseconds(100);
        for (int i = 0; i < 100; ++i) {
            const CompileLimit limit("k.comp");
            const clock_t begin = clock();
            while (clock() - begin < CLOCKS_PER_SEC / 50) continue;
        }
    };
    EXPECT_EXIT(run(), ::testing::ExitedWithCode(2), "k.comp takes too much");
}

}  // namespace
}  // namespace porttool::testing::spirv_test
