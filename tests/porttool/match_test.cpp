// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Pairing: what belongs together is found across languages, and what has no counterpart stays alone.
#include "porttool/match/match.h"

#include <gtest/gtest.h>

#include <chrono>

#include "porttool/match/words.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

Matching match(const std::vector<std::pair<std::string, std::string>>& source,
               const std::vector<std::pair<std::string, std::string>>& target, const Settled& settled = {}) {
    std::vector<ScannedFile> left, right;
    for (const auto& [path, text] : source) left.push_back(scan_text(path, text));
    for (const auto& [path, text] : target) right.push_back(scan_text(path, text));
    return match_units(left, right, settled, Dialect());
}

Pairs pairs(const Matching& matching) {
    Pairs out;
    for (const MatchedPair& pair : matching.pairs) out.emplace_back(pair.source, pair.target);
    return out;
}

TEST(Words, NamesAreSplitAndFolded) {
    EXPECT_EQ(split_words("BSDFEvaluate_f32"), (std::vector<std::string>{"bsdf", "evaluat", "f32"}));
    EXPECT_EQ(split_words("dequantize_q4_0").front(), split_words("dequantQ4").front());
    EXPECT_EQ(fold("kMaxDepth"), fold("MAX_DEPTH"));
    EXPECT_EQ(file_stem("a/.cuda.cu"), "cuda");
}

TEST(Match, AMethodIsTheFunctionOfItsFullName) {
    const Matching got = match(
        {{"cl/matte_funcs.cl",
          "float3 MatteMaterial_Evaluate(__global float* kd, float3 wi) { return kd[0] * fabs(wi.z) * M_1_PI_F; }\n"
          "float MatteMaterial_Pdf(float3 wi) { return wi.z > 0.f ? wi.z / M_PI_F : 0.f; }\n"},
         {"cl/mirror_funcs.cl",
          "float3 MirrorMaterial_Evaluate(__global float* kr, float3 wi) { return (float3)(0.f, 0.f, 0.f); }\n"}},
        {{"cpp/matte.cpp",
          "Spectrum MatteMaterial::Evaluate(const Vector& wi) const { return kd * fabsf(wi.z) * INV_PI; }\n"
          "float MatteMaterial::Pdf(const Vector& wi) const { return wi.z > 0.f ? wi.z / M_PI : 0.f; }\n"
          "MatteMaterial::MatteMaterial(float a) : kd(a) { }\n"},
         {"cpp/mirror.cpp", "Spectrum MirrorMaterial::Evaluate(const Vector& wi) const { return Spectrum(); }\n"}});
    EXPECT_EQ(pairs(got),
              (Pairs{{"cl/matte_funcs.cl:MatteMaterial_Evaluate", "cpp/matte.cpp:MatteMaterial::Evaluate"},
                     {"cl/matte_funcs.cl:MatteMaterial_Pdf", "cpp/matte.cpp:MatteMaterial::Pdf"},
                     {"cl/mirror_funcs.cl:MirrorMaterial_Evaluate", "cpp/mirror.cpp:MirrorMaterial::Evaluate"}}));
    EXPECT_EQ(got.unmapped_target, std::vector<std::string>{"cpp/matte.cpp:MatteMaterial::MatteMaterial"});
}

TEST(Match, AMainIsTheKernelThatItsFileIsNamedAfter) {
    const Matching got = match(
        {{"cuda/softmax.cu",
          "__global__ void soft_max_f32(const float* x, float* y, int n) { y[threadIdx.x] = expf(x[threadIdx.x]) / n; "
          "}\n"
          "void soft_max_f32_cuda(const float* x, float* y, int n) { soft_max_f32<<<1, n>>>(x, y, n); }\n"},
         {"cuda/argsort.cu",
          "__global__ void k_argsort(const float* x, int* y, int n) { int i = threadIdx.x; if (x[i] > x[i + 1]) y[i] = "
          "i + 1; }\n"}},
        {{"glsl/soft_max.comp", "void main() { y[gl_LocalInvocationID.x] = exp(x[gl_LocalInvocationID.x]) / n; }\n"},
         {"glsl/argsort.comp",
          "void main() { uint i = gl_LocalInvocationID.x; if (x[i] > x[i + 1]) y[i] = i + 1; }\n"}});
    EXPECT_EQ(pairs(got), (Pairs{{"cuda/argsort.cu:k_argsort", "glsl/argsort.comp:main"},
                                 {"cuda/softmax.cu:soft_max_f32", "glsl/soft_max.comp:main"}}));
}

TEST(Match, WhatHasNoCounterpartStaysUnmapped) {
    const Matching got = match(
        {{"a/trace.cu",
          "__device__ int push_node(int* stack, int node) { stack[0] = node; return 1; }\n"
          "__device__ float3 random_direction(uint seed) { return make_float3(cosf(seed), sinf(seed), 0.f); }\n"}},
        {{"b/scene.cpp",
          "void Scene::load(const std::string& path) { parse(path); }\n"
          "int Scene::count() const { return meshes.size(); }\n"}});
    EXPECT_TRUE(got.pairs.empty());
    EXPECT_EQ(got.unmapped_source.size(), 2u);
    EXPECT_EQ(got.unmapped_target.size(), 2u);
}

TEST(Match, ConstantsPairByNameWhateverTheirSpelling) {
    const Matching got = match({{"a.h", "#define MAX_PATH_LENGTH 8\n#define OTHER 3\n"}},
                               {{"b.h", "constexpr int kMaxPathLength = 7;\nconst float some = 3;\n"}});
    EXPECT_EQ(pairs(got), (Pairs{{"a.h:MAX_PATH_LENGTH", "b.h:kMaxPathLength"}}));
}

TEST(Match, WhatAPersonSettledStands) {
    Settled settled;
    settled.pairs = {{"a.cu:f", "b.cpp:g"}, {"a.cu:f", "b.cpp:h"}};
    settled.ignored = {"a.cu:debug*"};
    const Matching got = match(
        {{"a.cu", "int f(int a) { return a; }\nint debug_print(int a) { return a; }\n"}},
        {{"b.cpp", "int g(int a) { return a; }\nint h(int a) { return a; }\nint debug_print(int a) { return a; }\n"}},
        settled);
    EXPECT_EQ(pairs(got), (Pairs{{"a.cu:f", "b.cpp:g"}, {"a.cu:f", "b.cpp:h"}}));
    EXPECT_TRUE(got.unmapped_source.empty());
    EXPECT_EQ(got.pairs[0].state, PairState::Confirmed);
}

/// Makes a side of many files with functions of words that each differ.
std::vector<std::pair<std::string, std::string>> many(size_t functions, bool port) {
    std::vector<std::pair<std::string, std::string>> files;
    for (size_t i = 0; i < functions; ++i) {
        if (i % 20 == 0)
            files.emplace_back((port ? "port/part" : "src/part") + std::to_string(i / 20) + (port ? ".cpp" : ".cu"),
                               "");
        const std::string n = std::to_string(i), word = "item" + std::to_string(i * 7919 % 10007);
        files.back().second += (port ? "float compute_" : "__device__ float compute_") + word + "_" + n +
                               "(float a, int b) {\n  float " + word + " = a * " + n +
                               ".5f;\n  for (int i = 0; i < b; ++i) {\n    " + word + " += helper_" + n + "(i, " +
                               word + ");\n    if (" + word + " > " + n + ".0f) break;\n  }\n  return " +
                               (port ? "std::min(" : "fminf(") + word + ", 1.0f);\n}\n";
    }
    return files;
}

TEST(Match, IsFastAndGrowsGently) {
    const auto seconds = [](size_t functions) {
        const auto source = many(functions, false), target = many(functions, true);
        const auto start = std::chrono::steady_clock::now();
        const Matching got = match(source, target);
        EXPECT_GT(got.pairs.size(), functions * 95 / 100);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const double small = seconds(1000);
    const double large = seconds(8000);  // 8,000 + 8,000 functions of 8 lines: 128,000 lines
    EXPECT_LT(large, 16 * small + 1.0);
    RecordProperty("seconds_for_128000_lines", std::to_string(large));
}

}  // namespace
}  // namespace porttool
