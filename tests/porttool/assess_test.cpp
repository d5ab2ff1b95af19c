// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What is recorded is not verified: who compared the texts of a pair, and what they say to each other at init.
#include <gtest/gtest.h>

#include "tests/porttool/run_command.h"

namespace porttool::testing::assess_test {
namespace {

using nlohmann::json;

CommandRun porttool_in_r(Disk& disk, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"-C", "/r"});
    return run(disk, arguments);
}

/// A pair whose label was written down by reading both texts.
struct Labelled {
    const char* name;
    std::string source, target;
    const char* label;
};

const std::vector<Labelled>& labelled_pairs() {
    static const std::vector<Labelled> kPairs = {
        {"lum", "__device__ float lum(float3 c) { return 0.2f * c.x + 0.7f * c.y + 0.1f * c.z; }\n",
         "float lum(vec3 c) { return 0.2 * c.x + 0.7 * c.y + 0.1 * c.z; }\n", "twin"},
        {"powers",
         "__device__ float powers(float c, float f0) {\n    float k = 1.0f - c;\n    return f0 + k * k * k;\n}\n",
         "float powers(float cosine, float f0) {\n    float left = 1.0 - cosine;\n    return f0 + left * left * "
         "left;\n}\n",
         "twin"},
        {"wide", "__device__ long wide(int n) {\n    return 1ull << n;\n}\n",
         "long wide(int n) {\n    return 1 << n;\n}\n", "differs"},
        {"LIMIT", "#define LIMIT 16\n", "const int LIMIT = 1 << 4;\n", "equivalent"},
        {"DEPTH", "#define DEPTH 8\n", "#define DEPTH 9\n", "differs"},
        {"Ray", "struct Ray { float3 o; float t; };\n", "struct Ray { vec3 o; float t; };\n", "twin"},
        {"Hit", "struct Hit { float t; int prim; };\n", "struct Hit { int prim; float t; };\n", "differs"},
        {"fade",
         "__device__ float fade(float t) {\n    float a = t * t * t;\n    return a * (t * (t * 6.0f - 15.0f) + "
         "10.0f);\n}\n",
         "float fade(float t) {\n    float a = t * t * t;\n    return a * (t * (t * 6.0 - 14.0) + 10.0);\n}\n",
         "differs"},
        {"store",
         "__device__ void store(float* film, int pixel, float value) {\n    atomicAdd(film + pixel, value);\n}\n",
         "void store(ivec2 place, vec4 radiance) {\n    vec4 old = imageLoad(accumulator, place);\n"
         "    imageStore(accumulator, place, old + radiance * exposure);\n    weight = 1.0;\n}\n",
         "unlike"},
    };
    return kPairs;
}

/// All of them in two files, and the map that pairs them.
MemoryDisk labelled_project() {
    MemoryDisk disk;
    std::string& map = disk.files["/r/portmap.toml"];
    map = "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n";
    for (const Labelled& pair : labelled_pairs()) {
        disk.files["/r/src/k.cu"] += pair.source;
        disk.files["/r/port/k.comp"] += pair.target;
        map += std::string("[[pair]]\nsource = \"src/k.cu:") + pair.name + "\"\ntarget = \"port/k.comp:" + pair.name +
               "\"\n";
    }
    return disk;
}

std::map<std::string, std::string> labels(const std::string& out) {
    std::map<std::string, std::string> found;
    const json report = json::parse(out);
    for (const auto& pair : report["pairs"]) found[pair["source"].get<std::string>().substr(9)] = pair["assessment"];
    return found;
}

TEST(Assess, SaysOfEachPairWhatAReaderSaysAndWritesNothingWhereAMapIs) {
    MemoryDisk disk = labelled_project();
    const auto before = disk.files;
    const CommandRun got = porttool_in_r(disk, {"init", "--assess", "--format", "json"});
    ASSERT_EQ(got.exit_code, 0) << got.err;
    std::map<std::string, std::string> expected;
    for (const Labelled& pair : labelled_pairs()) expected[pair.name] = pair.label;
    EXPECT_EQ(labels(got.out), expected);
    EXPECT_EQ(disk.files, before);
    const CommandRun text = porttool_in_r(disk, {"init", "--assess"});
    EXPECT_NE(text.out.find("9 pairs: 3 twin, 1 equivalent, 4 differs, 1 unlike\n"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("unlike   src/k.cu:store = port/k.comp:store"), std::string::npos) << text.out;
    const CommandRun globs =
        porttool_in_r(disk, {"init", "--assess", "--source", "src/*", "--target", "port/*", "--format", "json"});
    EXPECT_EQ(labels(globs.out), expected);
    EXPECT_EQ(disk.files, before);
}

/// Two functions `f`, each in a language that its suffix tells, and what a reader says of them.
struct LabelledTexts {
    const char* source_suffix;
    std::string source;
    const char* target_suffix;
    std::string target;
    const char* label;
};

TEST(Assess, WhatComputesTheSameIsEquivalentInTheMannerOfEachLanguage) {
    const std::vector<LabelledTexts> kTexts = {
        {"glsl", "float f(vec3 c) { return 0.2 * c.x; }", "cpp", "inline float f(const vec3& c) { return 0.2f * c.x; }",
         "equivalent"},
        {"glsl", "float f(vec3 c) { return 0.2 * c.x; }", "cpp", "inline float f(const vec3& c) { return 0.2f * c.y; }",
         "differs"},
        {"glsl", "void f(inout vec3 a, in float b) { a += vec3(b); }", "cpp",
         "void f(float3 &a, const float b) { a += float3(b); }", "equivalent"},
        {"glsl", "void f(inout vec3 a, in float b) { a += vec3(b); }", "cpp",
         "void f(float3 a, const float b) { a += float3(b); }", "differs"},
        {"cu", "__device__ void f(float* o, float v) { *o = v; }", "cpp", "void f(float& o, float v) { o = v; }",
         "equivalent"},
        {"cl", "float3 f(__global const Hit *hit, const float3 a) { return make_float3(hit->p.x, a.y, hit->p.z); }",
         "cpp", "Spectrum f(const Hit &hit, const Spectrum &a) { return Spectrum(hit.p.x, a.y, hit.p.z); }",
         "equivalent"},
        {"cl", "float3 f(__global const Hit *hit, const float3 a) { return make_float3(hit->p.x, a.y, hit->p.z); }",
         "cpp", "Spectrum f(const Hit &hit, const Spectrum &a) { return Spectrum(hit.p.x, a.y, hit.p.y); }", "differs"},
        {"cu",
         "__device__ float f(const float* a, int n) { float s = 0.f; for (int i = 0; i < n; ++i) s += a[i]; return s; "
         "}",
         "cpp",
         "float f(const float* a, int n) { float s = 0.0f; int i = 0; while (i < n) { s = s + a[i]; i++; } return s; }",
         "equivalent"},
        {"cu",
         "__device__ float f(const float* a, int n) { float s = 0.f; for (int i = 0; i < n; ++i) s += a[i]; return s; "
         "}",
         "cpp",
         "float f(const float* a, int n) { float s = 0.0f; int i = 0; while (i <= n) { s = s + a[i]; i++; } return s; "
         "}",
         "differs"},
        {"cu", "__device__ void f(float* o, int i, float v) { if (i < 0) return; o[i] = v; }", "cpp",
         "void f(float* o, int i, float v) { if (i >= 0) { o[i] = v; } }", "equivalent"},
        {"glsl", "float f(float a) { return a > 0.0 ? a : 0.0; }", "cpp",
         "float f(float a) { if (a > 0.0f) return a; return 0.0f; }", "equivalent"},
        {"cu", "__device__ float f(float a) { return a * 0.5f; }", "cpp", "double f(double a) { return a * 0.5f; }",
         "differs"},
        {"glsl", "float f(Ray r) { r.t = 1.0; return r.t; }", "cpp", "float f(const Ray* r) { return 1.0f; }",
         "differs"},
    };
    for (const LabelledTexts& pair : kTexts) {
        MemoryDisk disk;
        const std::string source = std::string("src/k.") + pair.source_suffix,
                          target = std::string("port/k.") + pair.target_suffix;
        disk.files = {{"/r/" + source, pair.source + "\n"},
                      {"/r/" + target, pair.target + "\n"},
                      {"/r/portmap.toml",
                       "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n[[pair]]\nsource = \"" +
                           source + ":f\"\ntarget = \"" + target + ":f\"\n"}};
        const CommandRun got = porttool_in_r(disk, {"init", "--assess", "--format", "json"});
        ASSERT_EQ(got.exit_code, 0) << got.err;
        const std::string said = json::parse(got.out)["pairs"][0]["assessment"];
        const bool same = said == "twin" || said == "equivalent";
        EXPECT_EQ(same, std::string(pair.label) == "equivalent") << pair.source << pair.target << said;
    }
}

TEST(Assess, WithoutAMapItIsInitAndWhatSaysTheSameIsVerified) {
    MemoryDisk disk = labelled_project();
    disk.files.erase("/r/portmap.toml");
    const CommandRun got =
        porttool_in_r(disk, {"init", "--assess", "--source", "src/*", "--target", "port/*", "--format", "json"});
    ASSERT_EQ(got.exit_code, 0) << got.err;
    size_t same = 0, all = 0;
    for (const auto& [name, label] : labels(got.out)) {
        ++all;
        same += label == "twin" || label == "equivalent" ? 1 : 0;
    }
    EXPECT_GE(all, 6u);
    const json summary = check(disk)["summary"];
    EXPECT_EQ(summary["verified"], same);
    EXPECT_EQ(summary["recorded"], all - same);
}

TEST(Verified, AfterInitThePairsAreRecordedAndNotVerified) {
    MemoryDisk disk = started(labelled_pairs()[0].source + labelled_pairs()[1].source,
                              labelled_pairs()[0].target + labelled_pairs()[1].target);
    EXPECT_EQ(check(disk)["summary"]["recorded"], 2);
    EXPECT_EQ(check(disk)["summary"]["verified"], 0);
    EXPECT_NE(porttool_in_r(disk, {"check"}).out.find("recorded, not verified\n"), std::string::npos);
    EXPECT_NE(porttool_in_r(disk, {"check", "--format", "markdown"}).out.find("recorded, not verified"),
              std::string::npos);
    EXPECT_NE(porttool_in_r(disk, {"report"}).out.find("recorded, not verified"), std::string::npos);
    EXPECT_EQ(porttool_in_r(disk, {"accept", "src/k.cu:lum"}).exit_code, 0);
    EXPECT_EQ(check(disk)["summary"]["recorded"], 1);
    EXPECT_EQ(check(disk)["summary"]["verified"], 1);
    EXPECT_EQ(porttool_in_r(disk, {"check"}).out.find("not verified"), std::string::npos);
}

TEST(Verified, ItOutlivesTheSameEditOnBothSidesAndNoOther) {
    const Labelled& lum = labelled_pairs()[0];
    MemoryDisk disk = started(lum.source, lum.target);
    EXPECT_EQ(porttool_in_r(disk, {"accept", "src/k.cu:lum"}).exit_code, 0);
    disk.files["/r/src/k.cu"] = replaced(lum.source, "0.2f", "0.3f");
    disk.files["/r/port/k.comp"] = replaced(lum.target, "0.2", "0.3");
    EXPECT_EQ(porttool_in_r(disk, {"accept", "--all"}).exit_code, 0);
    EXPECT_EQ(check(disk)["summary"]["verified"], 1);
    disk.files["/r/src/k.cu"] = replaced(lum.source, "0.2f", "0.4f");
    EXPECT_EQ(porttool_in_r(disk, {"accept", "--all", "--force"}).exit_code, 0);
    EXPECT_EQ(check(disk)["summary"]["verified"], 0) << "nobody looked";
}

}  // namespace
}  // namespace porttool::testing::assess_test
