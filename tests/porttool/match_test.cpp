// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Pairing: what belongs together is found across languages, and what has no counterpart stays alone.
#include "porttool/match/match.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "porttool/match/words.h"
#include "porttool/scan/scan.h"
#include "porttool/text/key_numbers.h"
#include "porttool/text/text_numbers.h"
#include "tests/porttool/fixtures.h"

namespace porttool::match_test {
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

TEST(Words, KeysAreNumberedInTheOrderInWhichTheyCome) {
    KeyNumbers numbers;
    std::vector<uint64_t> keys;
    for (uint64_t i = 0; i < 5000; ++i)
        for (const uint64_t step : {uint64_t{1}, uint64_t{1} << 32, ~uint64_t{0} / 5000}) keys.push_back(i * step);
    std::map<uint64_t, uint32_t> expected;
    for (int round = 0; round < 2; ++round)
        for (const uint64_t key : keys) {
            const auto next = static_cast<uint32_t>(expected.size());
            EXPECT_EQ(numbers.number(key, next), expected.try_emplace(key, next).first->second) << key;
        }
}

TEST(Words, TextsAreNumberedInTheOrderInWhichTheyCome) {
    TextNumbers numbers;
    EXPECT_EQ(numbers.find("a"), TextNumbers::kNone);
    std::vector<std::string> texts = {"", std::string(100'000, 'x'), std::string("a\0b", 3), std::string("a\0c", 3)};
    for (int i = 0; i < 5000; ++i) texts.push_back(std::to_string(i % 3000));
    std::map<std::string, uint32_t> expected;
    for (int round = 0; round < 2; ++round)
        for (const std::string& text : texts) {
            const auto next = static_cast<uint32_t>(expected.size());
            EXPECT_EQ(numbers.number(text), expected.try_emplace(text, next).first->second) << text;
        }
    EXPECT_EQ(numbers.size(), expected.size());
    for (const auto& [text, number] : expected) {
        EXPECT_EQ(numbers.find(text), number);
        EXPECT_EQ(numbers.text(number), text);
    }
    EXPECT_EQ(numbers.find("3000"), TextNumbers::kNone);
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

/// A family of functions that differ by one word alone, each name as `name` makes it.
template <class Name>
std::string family(const std::vector<std::string>& members, const std::string& qualifier, const Name& name) {
    std::string text;
    for (size_t i = 0; i < members.size(); ++i)
        text += qualifier + "float " + name(members[i]) + "(const float* x, const float* y, int n) {\n" +
                "  float total = 0.0f;\n  for (int i = 0; i < n; ++i) total += x[i] * y[i] * scale_of(x, i, " +
                std::to_string(i + 2) + ");\n  return total;\n}\n";
    return text;
}

TEST(Match, AVariantOfTheTargetsOwnIsNoPort) {
    const std::vector<std::string> all = {"q4_0", "q4_1", "q5_0", "q5_1", "q8_0"},
                                   ported = {"q4_0", "q4_1", "q5_0", "q8_0"};
    const auto plain = [](const std::string& member) { return "vec_dot_" + member; };
    const auto reordered = [](const std::string& member) { return "vec_dot_" + member + "_reorder"; };
    const Matching got = match({{"cuda/dot.cu", family(all, "__device__ ", plain)}},
                               {{"sycl/dot.cpp", family(ported, "", plain) + family(all, "", reordered)}});
    EXPECT_EQ(pairs(got), (Pairs{{"cuda/dot.cu:vec_dot_q4_0", "sycl/dot.cpp:vec_dot_q4_0"},
                                 {"cuda/dot.cu:vec_dot_q4_1", "sycl/dot.cpp:vec_dot_q4_1"},
                                 {"cuda/dot.cu:vec_dot_q5_0", "sycl/dot.cpp:vec_dot_q5_0"},
                                 {"cuda/dot.cu:vec_dot_q8_0", "sycl/dot.cpp:vec_dot_q8_0"}}));
    EXPECT_EQ(got.unmapped_source, std::vector<std::string>{"cuda/dot.cu:vec_dot_q5_1"});
}

TEST(Match, ASiblingIsNoPort) {
    const std::vector<std::string> source = {"q4_0", "q4_1", "q5_0", "q5_1", "q8_0"};
    const std::vector<std::string> target = {"q4_0", "q4_1", "q5_0", "q8_0", "q8_1"};  // q5_1 is missing, q8_1 is new
    const auto name = [](const std::string& member) { return "copy_block_of_row_" + member; };
    const Matching got = match({{"cuda/copy_block.cu", family(source, "__device__ ", name)}},
                               {{"sycl/copy_block.cpp", family(target, "", name)}});
    EXPECT_EQ(got.pairs.size(), 4u);
    EXPECT_EQ(got.unmapped_source, std::vector<std::string>{"cuda/copy_block.cu:copy_block_of_row_q5_1"});
    EXPECT_EQ(got.unmapped_target, std::vector<std::string>{"sycl/copy_block.cpp:copy_block_of_row_q8_1"});
}

TEST(Match, AFamilyThatIsRenamedThroughoutMapsOneToOne) {
    const std::vector<std::string> materials = {"Brick", "Marble", "Wood", "Checker", "Cloud", "Band"};
    std::vector<std::pair<std::string, std::string>> source, target;
    Pairs expected;
    for (const std::string& name : materials) {
        source.emplace_back(
            "cl/textures.cl",
            "float " + name + "Texture_ConstEvaluateFloat(float a, float b) {\n  return a > " + "b ? a - b : b;\n}\n");
        target.emplace_back("cpp/" + name + ".cpp",
                            "float " + name + "Texture::GetFloatValue(const HitPoint& hit) const {\n" +
                                "  return Sub(first->GetFloatValue(hit), second->GetFloatValue(hit));\n}\n" + name +
                                "Texture::" + name + "Texture(const float a, const float b) : a_(a), b_(b) { }\n");
        expected.emplace_back(source.back().first + ":" + name + "Texture_ConstEvaluateFloat",
                              target.back().first + ":" + name + "Texture::GetFloatValue");
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(pairs(match(source, target)), expected);
}

TEST(Match, AConstructorIsNoFunctionsPort) {
    std::vector<std::pair<std::string, std::string>> source, target;
    for (const std::string name : {"MengerSponge", "JuliaSet", "KochCurve", "BoxFold", "QuatBulb"}) {
        source.emplace_back("formula/cl/" + name + ".cl",
                            family({name}, "", [](const std::string& m) { return m + "Iteration"; }));
        const std::string scope = "Fractal" + name;
        target.emplace_back("formula/cpp/fractal_" + name + ".cpp",
                            scope + "::" + scope + "(const float* x, int n) {\n  float total = 0.0f;\n" +
                                "  for (int i = 0; i < n; ++i) total += x[i] * scale_of(x, i, 2);\n}\n");
        if (name != "KochCurve")
            target.back().second += family({scope}, "", [](const std::string& m) { return m + "::FormulaCode"; });
    }
    const Matching got = match(source, target);
    EXPECT_EQ(got.pairs.size(), 4u);
    EXPECT_EQ(got.unmapped_source, std::vector<std::string>{"formula/cl/KochCurve.cl:KochCurveIteration"});
}

TEST(Match, AMainThatIsAVariantOfTheTargetsOwnIsNoPort) {
    std::vector<std::pair<std::string, std::string>> source{{"cuda/operations.cu", ""}}, target;
    const auto body = [](const std::string& word) {
        return "{ uint i = index(); y[i] = x[i] * " + word + "_factor; z[i] = y[i] + " + word + "(x[i]); }\n";
    };
    for (const std::string name : {"add", "mul", "norm", "repeat"}) {
        source.front().second += "__global__ void k_" + name + "(float* x, float* y) " + body(name);
        if (name != "repeat") target.emplace_back("glsl/" + name + ".comp", "void main() " + body(name));
        target.emplace_back("glsl/" + name + "_partials.comp",
                            "void main() { for (uint k = 0; k < rows; ++k) total += " + name + "(x[k], rows - k); }\n");
    }
    const Matching got = match(source, target);
    EXPECT_EQ(pairs(got), (Pairs{{"cuda/operations.cu:k_add", "glsl/add.comp:main"},
                                 {"cuda/operations.cu:k_mul", "glsl/mul.comp:main"},
                                 {"cuda/operations.cu:k_norm", "glsl/norm.comp:main"}}));
}

TEST(Match, AMainIsAKernelsPortBeforeAHelpers) {
    const std::string unpack = "{ y[i] = scale * float(x[i] & 15) - offset; y[i + 1] = scale * float(x[i] >> 4); ";
    const Matching got =
        match({{"cuda/convert.cu",
                "__device__ void dequantize_q4(const uint* x, float* y, int i) " + unpack + "}\n" +
                    "__global__ void dequantize_block_q4(const uint* x, float* y) { int i = threadIdx.x;\n" +
                    "  for (int k = 0; k < 4; ++k) " + unpack + "} }\n"}},
              {{"glsl/dequant_q4.comp", "void main() " + unpack + "uint i = gl_LocalInvocationID.x; }\n"}});
    EXPECT_EQ(pairs(got), (Pairs{{"cuda/convert.cu:dequantize_block_q4", "glsl/dequant_q4.comp:main"}}));
}

TEST(Match, WithoutKernelsAMainIsAFunctionsPort) {
    const Matching got = match({{"cpp/connect.cpp",
                                 "void connect(int job) { if (!trace_any(job)) add_radiance(job, 0.5f); }\n"
                                 "void extend(int job) { hits[job] = trace_closest(rays[job], 1e30f); }\n"}},
                               {{"glsl/connect.comp", "void main() { if (!trace_any(job)) add_radiance(job, 0.5); }\n"},
                                {"glsl/extend.comp", "void main() { hits[job] = trace_closest(rays[job], 1e30); }\n"}});
    EXPECT_EQ(pairs(got), (Pairs{{"cpp/connect.cpp:connect", "glsl/connect.comp:main"},
                                 {"cpp/connect.cpp:extend", "glsl/extend.comp:main"}}));
}

TEST(Match, OverloadsFindEachOtherByTheirParameters) {
    const Matching got =
        match({{"a/math.h",
                "float clamp01(float v) { return fminf(fmaxf(v, 0.0f), 1.0f); }\n"
                "float2 clamp01(float2 v) { return make_float2(clamp01(v.x), clamp01(v.y)); }\n"
                "float4 clamp01(float4 v, int lanes, float top) { return lanes > 2 ? top * v : v; }\n"}},
              {{"b/math.glsl",
                "vec4 clamp01(vec4 v, int lanes, float top) { return lanes > 2 ? top * v : v; }\n"
                "float clamp01(float v) { return min(max(v, 0.0), 1.0); }\n"
                "vec2 clamp01(vec2 v) { return vec2(clamp01(v.x), clamp01(v.y)); }\n"}});
    EXPECT_EQ(pairs(got), (Pairs{{"a/math.h:clamp01", "b/math.glsl:clamp01#2"},
                                 {"a/math.h:clamp01#2", "b/math.glsl:clamp01#3"},
                                 {"a/math.h:clamp01#3", "b/math.glsl:clamp01"}}));
}

TEST(Match, AnOperatorIsNamedAfterItsSign) {
    EXPECT_NE(fold("V::operator+"), fold("V::operator*"));
    const Matching got = match(
        {{"a/vec.h", "float3 operator+(float3 a, float3 b) { return make_float3(a.x + b.x, a.y + b.y, a.z); }\n"}},
        {{"b/vec.h", "vec3 operator*(vec3 a, vec3 b) { return vec3(a.x * b.x, a.y * b.y, a.z); }\n"}});
    EXPECT_TRUE(got.pairs.empty());
}

TEST(Match, NamesSpeakTheDialectOfTheirSide) {
    const Matching got = match(
        {{"cuda/tools.h", "float4 __uchar4_to_float4(uchar4 c) { return make_float4(c.x, c.y, c.z, c.w) * 0.5f; }\n"}},
        {{"glsl/tools.glsl", "vec4 uchar4_to_vec4(uint c) { return unpackUnorm4x8(c) * 0.5; }\n"}});
    EXPECT_EQ(pairs(got), (Pairs{{"cuda/tools.h:__uchar4_to_float4", "glsl/tools.glsl:uchar4_to_vec4"}}));
}

TEST(Match, TheScoreTellsCertainFromDoubtful) {
    const Matching got =
        match({{"a/shade.cu",
                "float fresnel(float c, float k) { float r = 1.0f - c; return k + (1.0f - k) * r * r * r; }\n"
                "float shadow_bias(float d) { return d * 0.001f + 0.25f; }\n"}},
              {{"b/shade.glsl",
                "float fresnel(float c, float k) { float r = 1.0 - c; return k + (1.0 - k) * r * r * r; }\n"
                "float bias_of_shadow(float d) { return d * 0.001 + 0.25; }\n"}});
    ASSERT_EQ(got.pairs.size(), 2u);
    EXPECT_GT(got.pairs[0].score, 0.9f);
    EXPECT_LT(got.pairs[1].score, got.pairs[0].score);
    EXPECT_GE(got.pairs[1].score, 0.5f);
}

/// The calls by which a host function sets a kernel's arguments and enqueues it, in several APIs.
std::string launcher(const std::string& name, size_t api) {
    const std::vector<std::string> bodies = {
        "  size_t sizes[] = {w, h};\n  clSetKernelArg(k, 0, sizeof(cl_mem), &in);\n  clSetKernelArg(k, 1, 4, &gain);\n"
        "  clEnqueueNDRangeKernel(q, k, 2, 0, sizes, 0, 0, 0, 0);\n",
        "  device->SetKernelArg(k, 0, in);\n  device->SetKernelArg(k, 1, gain);\n  device->EnqueueKernel(k, w, h);\n",
        "  ocl::Kernel k(\"" + name + "\", source);\n  k.args(in, gain);\n  return k.run(2, sizes, nullptr, false);\n",
        "  dim3 grid(w / 16, h / 16);\n  " + name + "_impl<<<grid, 256, 0, stream>>>(in, gain);\n",
    };
    return "void " + name + "(float* in, float gain, int w, int h) {\n" + bodies[api] + "}\n";
}

TEST(Match, ALauncherIsNoKernelsPort) {
    for (size_t api = 0; api < 4; ++api) {
        const Matching got =
            match({{"cl/tone.cl",
                    "__kernel void tone_curve(__global float* in, float gain, int w, int h) {\n"
                    "  int i = get_global_id(0); in[i] = pow(in[i] * gain, 0.45f); }\n"}},
                  {{"c/tone.cpp", launcher("tone_curve_on_device", api) + launcher("tone_curve", api)}});
        EXPECT_TRUE(got.pairs.empty()) << api << ": " << got.pairs[0].target;
    }
}

TEST(Match, TheFileIsTheNameWhereManyFilesHaveOneEntryPoint) {
    const std::map<std::string, std::string> bodies = {
        {"sharpen", "out[i] = in[i] + amount * (in[i] - 0.25f * (in[i - 1] + in[i + 1] + in[i - w] + in[i + w]));"},
        {"vignette", "out[i] = in[i] * (1.0f - strength * (x * x + y * y)); if (out[i] < floor_) out[i] = floor_;"},
        {"exposure", "out[i] = (in[i] - black) * scale;"},
        {"invert", "out[i] = film_color - in[i]; if (i % 4 == 3) out[i] = in[i]; count += 1; total = total + in[i];"},
        {"dither", "err = in[i] - floor(in[i] * levels) / levels; out[i] = in[i] + err * noise(i, seed);"}};
    std::vector<std::pair<std::string, std::string>> source, target;
    Pairs expected;
    for (const auto& [name, body] : bodies) {
        source.emplace_back("kernels/basic_" + name + ".cl",
                            "__kernel void " + name +
                                "_pixel(__global float* in, __global float* out, int w)"
                                " {\n  int i = get_global_id(0);\n  " +
                                body + "\n}\n");
        target.emplace_back("modules/" + name + ".c", "void init(module_t* self) { self->name = \"" + name +
                                                          "\"; self->priority = " + std::to_string(name.size() * 31) +
                                                          "; }\n" + "void process(const float* in, float* out, " +
                                                          "int w, int h) {\n  for (int i = 0; i < w * h; ++i) {\n    " +
                                                          body + "\n  }\n}\n" + launcher("process_cl", 0));
        expected.emplace_back(source.back().first + ":" + name + "_pixel", target.back().first + ":process");
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(pairs(match(source, target)), expected);
}

TEST(Match, OneFunctionPortsTheVariantsOfAKernel) {
    const auto kernel = [](const std::string& name, const std::string& type) {
        return "__kernel void kernel_" + name + "(__global " + type + "* x, __global " + type +
               "* y) {\n  int i = get_global_id(0);\n  y[i] = tanh(x[i]) * x[i] + 0.5f;\n}\n";
    };
    const Matching got = match(
        {{"cl/mish.cl", kernel("mish_f32", "float") + kernel("mish_f32_4", "float4") + kernel("mish_f16", "half")},
         {"cl/scan.cl", "__kernel void kernel_scan(__global int* a) { a[0] += a[1] + get_local_id(0); }\n"}},
        {{"c/mish.c",
          "void op_mish(const float* x, float* y, int n) {\n  for (int i = 0; i < n; ++i) y[i] = "
          "tanhf(x[i]) * x[i] + 0.5f;\n}\n"}});
    EXPECT_EQ(pairs(got), (Pairs{{"cl/mish.cl:kernel_mish_f16", "c/mish.c:op_mish"},
                                 {"cl/mish.cl:kernel_mish_f32", "c/mish.c:op_mish"},
                                 {"cl/mish.cl:kernel_mish_f32_4", "c/mish.c:op_mish"}}));
}

TEST(Match, AKernelStandsInTheFunctionThatPortsItsLauncher) {
    const std::string compute =
        "    float dx = x[i] - px; float dy = y[i] - py;\n    energy[i] = q[i] * rsqrtf(dx * dx + dy * dy + 0.01f);\n";
    const Matching got = match(
        {{"cuda/coulomb.cu",
          "__global__ void field(const float* x, const float* y, const float* q, float* energy, float px, float py) {\n"
          "    int i = blockIdx.x * blockDim.x + threadIdx.x;\n" +
              compute + "}\n" +
              "void coulomb(float* x, float* y, float* q, float* energy, float px, float py, int n) {\n" +
              "  check(n); upload(x, n); upload(y, n);\n  field<<<n / 256, 256>>>(x, y, q, energy, px, py);\n" +
              "  download(energy, n);\n}\n"}},
        {{"omp/coulomb.cpp",
          "void coulomb(float* x, float* y, float* q, float* energy, float px, float py, int n) {\n  check(n);\n"
          "  #pragma omp parallel for\n  for (int i = 0; i < n; ++i) {\n" +
              compute + "  }\n}\n"}});
    EXPECT_EQ(pairs(got), (Pairs{{"cuda/coulomb.cu:coulomb", "omp/coulomb.cpp:coulomb"},
                                 {"cuda/coulomb.cu:field", "omp/coulomb.cpp:coulomb"}}));
}

TEST(Match, AKernelStandsInWhatThePortOfItsLaunchersCallerCalls) {
    const std::string cell = "m[k] = max(m[k - n - 1] + cost[k], max(m[k - 1] - penalty, m[k - n] - penalty));";
    const std::string head = "(const int* cost, int* m, int n, int penalty";
    const Matching got =
        match({{"cuda/align.cu",
                "__global__ void sweep_down" + head + ") {\n  int k = blockIdx.x * blockDim.x + threadIdx.x;\n  " +
                    cell + "\n}\n__global__ void sweep_up" + head +
                    ") {\n  int k = n * n - 1 - blockIdx.x * blockDim.x - threadIdx.x;\n  " + cell +
                    "\n}\nvoid score_on_device" + head +
                    ") {\n  sweep_down<<<n, 16>>>(cost, m, n, penalty);\n  sweep_up<<<n, 16>>>(cost, m, n, "
                    "penalty);\n}\n"
                    "void run_test(int argc, char** argv) {\n  int* m = read_table(argv[1]); int* cost = "
                    "read_table(argv[2]);\n"
                    "  score_on_device(cost, m, atoi(argv[3]), atoi(argv[4]));\n  print_table(m);\n}\n"}},
              {{"omp/align.cpp",
                "void fill_by_blocks" + head + ") {\n  for (int k = n + 1; k < n * n; ++k) " + cell +
                    "\n}\nvoid run_test(int argc, char** argv) {\n  int* m = read_table(argv[1]); int* cost = "
                    "read_table(argv[2]);\n"
                    "  fill_by_blocks(cost, m, atoi(argv[3]), atoi(argv[4]));\n  print_table(m);\n}\n"}});
    EXPECT_EQ(pairs(got), (Pairs{{"cuda/align.cu:run_test", "omp/align.cpp:run_test"},
                                 {"cuda/align.cu:sweep_down", "omp/align.cpp:fill_by_blocks"},
                                 {"cuda/align.cu:sweep_up", "omp/align.cpp:fill_by_blocks"}}));
}

TEST(Match, AKernelIsPortedByWhatCallsItsLauncherAndComputesAsWell) {
    const std::string lift = "dst[i] = src[i] + gain * (1.0f - src[i]) * exp(-4.0f * src[i]);\n";
    const Matching got = match(
        {{"kernels/tone.cl",
          "__kernel void lift_shadows(__global const float* src, __global float* dst, float gain, int n) {\n"
          "  int i = get_global_id(0);\n  if (i < n) " +
              lift + "}\n"}},
        {{"src/tone.cpp",
          "static bool enqueue_tone(const Image& src, Image& dst, float gain) {\n  Kernel k(\"lift_shadows\", "
          "program());\n  k.args(src, dst, gain, src.size());\n  return k.run(1, src.size());\n}\n"
          "void brighten(const Image& src, Image& dst, float gain) {\n  if (enqueue_tone(src, dst, gain)) return;\n"
          "  for (int i = 0; i < src.size(); ++i) " +
              lift +
              "}\nvoid darken(const Image& src, Image& dst, float gain) {\n"
              "  for (int i = 0; i < src.size(); ++i) dst[i] = src[i] - gain * src[i];\n}\n"}});
    EXPECT_EQ(pairs(got), (Pairs{{"kernels/tone.cl:lift_shadows", "src/tone.cpp:brighten"}}));
}

TEST(Match, WhatHandsOnToALauncherIsNoKernelsPort) {
    const std::string sharpen = "dst[i] = src[i] + gain * (src[i] - 0.5f * (src[i - 1] + src[i + 1]));\n";
    const Matching got = match(
        {{"gpu/kernels.cl",
          "__kernel void sharpen(__global const float* src, __global float* dst, float gain, int n) {\n"
          "  int i = get_global_id(0);\n  if (i > 0 && i + 1 < n) " +
              sharpen + "}\n"}},
        {{"gpu/launch.c",
          "static Image *compute_sharpen_image(const Image *in, Queue queue, float gain) {\n  Image *out = "
          "clone(in);\n  Kernel kernel = acquire_kernel(\"sharpen\");\n  set_kernel_arg(kernel, 0, in);\n"
          "  set_kernel_arg(kernel, 1, out);\n  enqueue_kernel(queue, kernel, in->size);\n  return out;\n}\n"
          "Image *sharpen_on_device(const Image *in, float gain) {\n  Image *out;\n  Queue *queue;\n"
          "  check(in != (Image *) NULL);\n  queue = get_queue((void *) NULL);\n  if (queue == (Queue *) NULL) return "
          "(Image *) NULL;\n  out = compute_sharpen_image(in, queue, gain);\n  return out;\n}\n"},
         {"core/effect.c",
          "Image *crisp(const Image *in, float gain) {\n  Image *out = sharpen_on_device(in, gain);\n  if (out != "
          "NULL) "
          "return out;\n  float *dst = new_row(), *src = row_of(in);\n  for (int i = 1; i + 1 < in->size; ++i) " +
              sharpen + "  return to_image(dst);\n}\n"}});
    EXPECT_EQ(pairs(got), (Pairs{{"gpu/kernels.cl:sharpen", "core/effect.c:crisp"}}));
}

TEST(Match, AKernelIsPortedByTheFunctionThatWorksAndNotByWhatHandsOn) {
    std::string kernels, functions, graph;
    Pairs expected;
    for (const auto& [name, value] : std::map<std::string, std::string>{{"fill", "value"},
                                                                        {"scale", "x[i] * value"},
                                                                        {"shift", "x[i] + value"},
                                                                        {"leaky", "x[i] > 0 ? x[i] : value * x[i]"},
                                                                        {"cube", "x[i] * x[i] * x[i] / value"}}) {
        kernels += "__global__ void " + name + "_kernel(const float* x, float* y, float value, int n) {\n" +
                   "  int i = blockIdx.x * blockDim.x + threadIdx.x;\n  if (i < n) y[i] = " + value + ";\n}\n";
        functions += "static void api_compute_forward_" + name +
                     "_f32(const params* p, tensor* dst) {\n  const float value = p->value; const float* x = "
                     "p->src;\n  float* y = dst->data;\n  for (int i = p->first; i < p->end; ++i) y[i] = " +
                     value + ";\n}\nvoid api_compute_forward_" + name +
                     "(const params* p, tensor* dst) {\n  switch (p->type) {\n    case TYPE_F32: "
                     "api_compute_forward_" +
                     name + "_f32(p, dst); break;\n    default: fail();\n  }\n}\n";
        graph +=
            "tensor *" + name +
            "(tensor *a, float value) {\n  const long size = a->n * a->m * a->k * 4 + 16 + a->n / 8;\n  tensor *out "
            "= new_tensor(a, size);\n  out->op = OP_ANY;\n  set_params(out, value);\n  return out;\n}\n";
        expected.emplace_back("cuda/ops.cu:" + name + "_kernel", "cpu/ops.c:api_compute_forward_" + name + "_f32");
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(pairs(match({{"cuda/ops.cu", kernels}}, {{"cpu/ops.c", functions}, {"cpu/graph.c", graph}})), expected);
}

TEST(Match, AKernelIsFoundInAFunctionByTheStringThatCreatesIt) {
    const std::string compute =
        "    float dx = x[i] - px; float dy = y[i] - py;\n    energy[i] = q[i] * rsqrt(dx * dx + dy * dy + 0.01f);\n";
    const Matching got = match(
        {{"cl/coulomb.cl",
          "__kernel void field(__global float* x, __global float* y, __global float* q, __global float* energy, float "
          "px, "
          "float py) {\n    int i = get_global_id(0);\n" +
              compute + "}\n"},
         {"cl/coulomb.c",
          "void coulomb(float* x, float* y, float* q, float* energy, float px, float py, int n) {\n  check(n); "
          "upload(x, "
          "n); upload(y, n);\n  cl_kernel k = clCreateKernel(program, \"field\", 0);\n  clSetKernelArg(k, 0, 8, &x);\n"
          "  clEnqueueNDRangeKernel(q, k, 1, 0, &n, 0, 0, 0, 0);\n  download(energy, n);\n}\n"}},
        {{"omp/coulomb.c",
          "void coulomb(float* x, float* y, float* q, float* energy, float px, float py, int n) {\n  check(n);\n"
          "  #pragma omp parallel for\n  for (int i = 0; i < n; ++i) {\n" +
              compute + "  }\n}\n"}});
    EXPECT_EQ(pairs(got), (Pairs{{"cl/coulomb.c:coulomb", "omp/coulomb.c:coulomb"},
                                 {"cl/coulomb.cl:field", "omp/coulomb.c:coulomb"}}));
}

TEST(Match, AConversionIsNotPortedByItsInverse) {
    const Matching got = match(
        {{"cl/convert.cl", "uint hex_to_u8(const uint* hex) { return (hex[0] & 15) * 16 + (hex[1] & 15); }\n"}},
        {{"c/convert.c", "u8 u8_to_hex(const u8 v, u8* hex) { hex[0] = v >> 4; hex[1] = v & 15; return hex[0]; }\n"}});
    for (const MatchedPair& pair : got.pairs) EXPECT_LT(pair.score, 0.9f);
    EXPECT_TRUE(converts("rgb2lab") && converts("HsvToRgb") && !converts("total_of") && !converts("sha256_init"));
}

TEST(Words, AProjectsOwnWordForInliningIsLeftToItsDialect) {
    EXPECT_EQ(Dialect().find("OUR_INLINE"), nullptr);
    const std::vector<std::pair<std::string, std::string>> rows = {{"OUR_INLINE", "inline"}};
    const Dialect dialect(rows);
    ASSERT_NE(dialect.find("OUR_INLINE"), nullptr);
    EXPECT_EQ(*dialect.find("OUR_INLINE"), "");
    EXPECT_EQ(*dialect.find("inline"), "");
}

TEST(Match, AnOverloadForOtherTypesIsNoPort) {
    const Matching got = match({{"a/math.h",
                                 "float sum_of(float3 v, float w) { return (v.x + v.y + v.z) * w; }\n"
                                 "float sum_of(int4 v, bool w) { return w ? v.x + v.y + v.z + v.w : 0; }\n"}},
                               {{"b/math.h", "float sum_of(vec3 v, float w) { return (v.x + v.y + v.z) * w; }\n"}});
    EXPECT_EQ(pairs(got), (Pairs{{"a/math.h:sum_of", "b/math.h:sum_of"}}));
}

TEST(Match, AnEqualNameOverBodiesWithNothingInCommonIsNotCertain) {
    const Matching got =
        match({{"cl/plugin_grain.cl",
                "__kernel void GrainPlugin_Copy(__global float* dst, __global const float* tmp, int n) "
                "{\n  int i = get_global_id(0); if (i < 3 * n) dst[i] = tmp[i] * 0.5f + dst[i];\n}\n"}},
              {{"cpp/grain.cpp", "Plugin* GrainPlugin::Copy() const { return new GrainPlugin(*this); }\n"}});
    for (const MatchedPair& pair : got.pairs) EXPECT_LT(pair.score, 0.9f) << pair.target;
}

TEST(Match, WhatOneSideHasThroughoutTellsNothing) {
    std::string source, target;
    Pairs expected;
    for (const std::string name : {"reverse", "rotate", "append", "purge", "mirror", "title"}) {
        const std::string body = "{ for (int i = 0; i < n; ++i) word[i] = " + name + "_of(word, i); return n; }\n";
        source += "int rule_" + name + "(char* word, int n) " + body;
        target += "int " + name + "(char* word, int n) " + body;
        expected.emplace_back("cl/rules.cl:rule_" + name, "c/words.c:" + name);
    }
    std::sort(expected.begin(), expected.end());
    const Matching got = match({{"cl/rules.cl", source}}, {{"c/words.c", target}});
    EXPECT_EQ(pairs(got), expected);
    for (const MatchedPair& pair : got.pairs) EXPECT_GE(pair.score, 0.7f) << pair.source;
}

TEST(Words, WhatJoinsWordsTellsNothing) {
    EXPECT_EQ(split_words("rgb_to_lab"), split_words("rgb2lab"));
    EXPECT_EQ(split_words("RGB2Lab"), split_words("rgb_2_lab"));
    EXPECT_EQ(split_words("conv2d"), split_words("conv_2d"));
    EXPECT_EQ(split_words("conv2d"), (std::vector<std::string>{"conv", "2d"}));
    EXPECT_EQ(split_words("sha256_init"), (std::vector<std::string>{"sha256", "init"}));
}

TEST(Match, OneSourceIsPortedByItsCopiesAndByVariantsForInstructionSets) {
    const std::string body =
        "(const float* row, int n) {\n  float best = row[0];\n  for (int i = 1; i < n; ++i) best = max(best, row[i] * "
        "0.75f + row[i - 1]);\n  return best;\n}\n";
    const Matching got =
        match({{"cl/rows.cl",
                "float best_of_row" + body + "float first_of_row(const float* row) { return row[0] + 1.0f; }\n"}},
              {{"c/left.c", "static float best_of_row" + body},
               {"c/right.c", "static float best_of_row" + body + "static float best_of_row_avx2" + body},
               {"c/other.c", "static float best_of_row_reversed" + body}});
    EXPECT_EQ(pairs(got), (Pairs{{"cl/rows.cl:best_of_row", "c/left.c:best_of_row"},
                                 {"cl/rows.cl:best_of_row", "c/right.c:best_of_row"},
                                 {"cl/rows.cl:best_of_row", "c/right.c:best_of_row_avx2"}}));
}

/// Two ports in folders of their own, under one glob each and too few to be told apart by their folders.
TEST(Match, ASecondPortInAnotherFolderIsWatchedAsWell) {
    const auto rows = [](const std::string& head, const std::string& at, const std::string& out) {
        return head + "    float s = 0.0f;\n    for (int k = 0; k < 8; ++k) s += weight(" + at + ");\n    " + out +
               " = s * 0.125f;\n}\n";
    };
    const std::string kernel = rows(
        "__kernel void mixRows(__global const float* a, __global float* o, int n)\n{\n    int i = get_global_id(0);\n"
        "    if (i >= n) return;\n",
        "a[i + k], a[i]", "o[i]");
    const std::string loop =
        rows("void mix_rows(const float* in, float* out, int n)\n{\n    for (int i = 0; i < n; ++i) {\n",
             "in[i + k], in[i]", "out[i]");
    const std::string main = rows(
        "layout(local_size_x = 64) in;\nvoid main()\n{\n    int i = int(gl_GlobalInvocationID.x);\n    if (i >= pc.n) "
        "return;\n",
        "a[i + k], a[i]", "o[i]");
    const std::string other = "void mix_rows(int how)\n{\n    log_mode(how);\n    select_mode(how, 3);\n}\n";
    const std::vector<std::pair<std::string, std::string>> source = {{"ocl/mix.cl", kernel}};
    EXPECT_EQ(
        pairs(match(source, {{"omp/mixer.cpp", loop + "}\n"}, {"vk/mix_rows.comp", main}})),
        (Pairs{{"ocl/mix.cl:mixRows", "omp/mixer.cpp:mix_rows"}, {"ocl/mix.cl:mixRows", "vk/mix_rows.comp:main"}}));
    EXPECT_EQ(pairs(match(source, {{"ui/mixer.cpp", other}, {"vk/mix_rows.comp", main}})),
              (Pairs{{"ocl/mix.cl:mixRows", "vk/mix_rows.comp:main"}}))
        << "a namesake that does something else is no port";
}

TEST(Match, ConstantsOfOneValuePairWherePairedFunctionsUseThemInOnePlace) {
    const auto side = [](const std::string& path, const std::string& constants, const std::string& name,
                         const std::string& line) {
        return std::pair<std::string, std::string>{path, constants + "void shade_row(const float* " + name +
                                                             ", float* out, int n) {\n  for (int i = 0; i < n; "
                                                             "++i) {\n    float v = " +
                                                             name + "[i];\n    " + line +
                                                             "\n    out[i] = v * 0.5f + sqrt(v);\n  }\n}\n"};
    };
    const auto constants_of = [](const Matching& got) {
        Pairs out = pairs(got);
        std::erase_if(out, [](const auto& pair) { return pair.first.ends_with(":shade_row"); });
        return out;
    };
    const auto source = [&](const std::string& value, const std::string& line) {
        return std::vector{side("a.cu", "__constant__ float gain = " + value + ";\n", "x", line)};
    };
    const auto target = [&](const std::string& constants, const std::string& line) {
        return std::vector{side("b.c", constants, "in", line)};
    };
    const Pairs found = {{"a.cu:gain", "b.c:AMPLIFY"}};
    EXPECT_EQ(constants_of(match(source("1.5f", "v *= gain;"), target("#define AMPLIFY 1.5f\n", "v *= AMPLIFY;"))),
              found);
    EXPECT_EQ(
        constants_of(match(source("1.375f", "v *= gain;"), target("#define AMPLIFY 1.375f\n", "v = AMPLIFY * v;"))),
        found)
        << "a rare value says it, wherever it stands";
    EXPECT_EQ(constants_of(match(source("2", "v *= gain;"), target("#define AMPLIFY 2\n", "v += AMPLIFY + v;"))),
              Pairs());
    EXPECT_EQ(constants_of(match(source("1.5f", "v *= gain;"), target("#define AMPLIFY 1.25f\n", "v *= AMPLIFY;"))),
              Pairs())
        << "other values";
    EXPECT_EQ(constants_of(match(source("1.5f", "v *= gain;"),
                                 target("#define AMPLIFY 1.5f\n#define DAMP 1.5f\n", "v *= AMPLIFY; v *= DAMP;"))),
              Pairs())
        << "either could be it";
    EXPECT_EQ(constants_of(match(source("1.5f", "v *= gain;"),
                                 target("#define AMPLIFY 1.5f\n", "v *= scale(v); use(p.AMPLIFY);"))),
              Pairs())
        << "a member of that name";
    EXPECT_EQ(constants_of(match(source("1.5f", "float gain = v; v *= gain;"),
                                 target("#define AMPLIFY 1.5f\n", "v *= AMPLIFY;"))),
              Pairs())
        << "a local of that name";
}

/// Names that tell nothing: what two units have in common, and no other unit has, is how they are written.
TEST(Match, WhatIsWrittenLikeNothingElseIsAPortUnderAnyName) {
    const std::string light = "float luma(float4 c)\n{\n    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;\n}\n";
    const std::string scan =
        "int prefix(int* v, int n)\n{\n    int s = 0;\n    for (int i = 0; i < n; ++i) { s += v[i]; v[i] = s; }\n    "
        "return "
        "s;\n}\n";
    const std::string found_by_numbers =
        "static float Luminance(const Pixel& p)\n{\n    return 0.2126f * p.r + 0.7152f * p.g + 0.0722f * p.b;\n}\n";
    const std::string other_numbers =
        "static float Average(const Pixel& p)\n{\n    return p.r / 3 + wide(p.g, p.b) * 0.25f - p.count;\n}\n";
    EXPECT_EQ(pairs(match({{"a.cl", light + scan}}, {{"b.cpp", found_by_numbers + other_numbers}})),
              (Pairs{{"a.cl:luma", "b.cpp:Luminance"}}));
    EXPECT_EQ(pairs(match({{"a.cl", light + scan}}, {{"b.cpp", other_numbers}})), Pairs());
    EXPECT_EQ(
        pairs(match({{"a.cl", light + scan}},
                    {{"b.cpp", found_by_numbers + "static float Weigh(const Pixel& p)\n{\n    return 0.2126f * p.b + "
                                                  "0.7152f * p.r + 0.0722f * p.g;\n}\n"}})),
        Pairs())
        << "either could be it";
    EXPECT_EQ(pairs(match({{"a.cl", light + scan}}, {{"b.cpp", found_by_numbers + other_numbers}},
                          Settled{{{"a.cl:prefix", ""}}, {}, true})),
              (Pairs{{"a.cl:prefix", ""}}))
        << "where the others of its side are not looked at, nobody knows that it is alone";
}

TEST(Match, ALambdaThatIsHandedToTheDeviceIsPortedByAKernel) {
    const std::string sum =
        "void sumForces(sycl::queue& q, const float* f, float* total, int n)\n{\n    q.parallel_for(sycl::range<1>(n), "
        "[=](sycl::id<1> i) {\n        float v = f[i];\n        float mag = sqrt(v * v + 0.25f);\n        "
        "add_to(*total, "
        "mag * v);\n    });\n}\n";
    const std::string launcher =
        "void sumForces(sycl::queue& q, const float* f, float* total, int n)\n{\n    q.parallel_for(sycl::range<1>(n), "
        "[=](sycl::id<1> i) { force_sum(f, total, n, i); });\n}\n";
    const std::string kernel =
        "__global__ void force_sum(const float* f, float* total, int n)\n{\n    int i = blockIdx.x * blockDim.x + "
        "threadIdx.x;\n    if (i >= n) return;\n    float v = f[i];\n    float mag = sqrt(v * v + 0.25f);\n    "
        "add_to(*total, mag * v);\n}\n";
    EXPECT_EQ(pairs(match({{"a.sycl.cpp", "#include <sycl/sycl.hpp>\n" + sum}}, {{"b.hip", kernel}})),
              (Pairs{{"a.sycl.cpp:sumForces", "b.hip:force_sum"}}));
    EXPECT_EQ(pairs(match({{"a.sycl.cpp", "#include <sycl/sycl.hpp>\n" + launcher}}, {{"b.hip", kernel}})), Pairs());
}

TEST(Match, OneFunctionHoldsAFamilyOfKernels) {
    const auto kernel = [](const std::string& name, const std::string& value) {
        return "__global__ void k_" + name +
               "(const float* x, float* y, int n) { int i = blockIdx.x * blockDim.x + "
               "threadIdx.x; if (i < n) y[i] = " +
               value + "; }\n";
    };
    const std::string relu = kernel("relu", "x[i] > 0.0f ? x[i] : 0.0f"),
                      silu = kernel("silu", "x[i] / (1.0f + expf(-x[i]))"),
                      gelu = kernel("gelu", "0.5f * x[i] * (1.0f + tanhf(0.79788456f * x[i]))");
    const auto holder = [](const std::string& a, const std::string& b, const std::string& c) {
        return "template <Act A> void apply_activation(const float* x, float* y, int n)\n{\n    for (int i = 0; i < n; "
               "++i) "
               "{\n        const float v = x[i];\n        if constexpr (A == Act::" +
               a +
               ") y[i] = v > 0.0f ? v : 0.0f;\n"
               "        else if constexpr (A == Act::" +
               b +
               ") y[i] = v / (1.0f + std::exp(-v));\n        else if constexpr "
               "(A == Act::" +
               c + ") y[i] = 0.5f * v * (1.0f + std::tanh(0.79788456f * v));\n    }\n}\n";
    };
    const std::string other =
        "void fold_rows(const double* rows, int count)\n{\n    double all = 0;\n    while (count-- > 0) all += *rows++ "
        "% 7;\n"
        "    report(all, count);\n}\n";
    const auto count = [&](const std::string& kernels, const std::string& target) {
        return pairs(match({{"ops.cu", kernels}}, {{"act.cpp", target + other}})).size();
    };
    EXPECT_EQ(count(relu + silu + gelu, holder("Relu", "Silu", "Gelu")), 3u);
    EXPECT_EQ(count(relu + silu + gelu, holder("First", "Second", "Third")), 0u) << "nothing says which it holds";
    EXPECT_EQ(count(relu + silu + gelu, other), 0u);
    EXPECT_EQ(count(relu + silu, holder("Relu", "Silu", "Gelu")), 0u) << "two are no family";
}

TEST(Match, OneFunctionHoldsTheStepsOfAFile) {
    const auto kernel = [](const std::string& name, const std::string& step) {
        return "__global__ void " + name +
               "(const double* price, double* gain, int days)\n{\n    const int day = blockIdx.x * blockDim.x + "
               "threadIdx.x;\n    if (day < days) {\n        " +
               step + "\n    }\n}\n";
    };
    const std::string rise = "gain[day] = price[day + 1] - price[day];",
                      fee = "if (gain[day] > 0.25) gain[day] -= 0.015 * gain[day] + 0.3;",
                      sum = "gain[day] += gain[day / 2] * 0.5 + gain[day / 3];";
    const std::string steps = kernel("first_step", rise) + kernel("second_step", fee) + kernel("third_step", sum);
    const std::string loop = "    for (int day = 0; day < days; ++day) ";
    const std::string holder = "void Trades::execute(const double* price, double* gain, int days)\n{\n" + loop + "{ " +
                               rise + " }\n" + loop + "{ " + fee + " }\n" + loop + "{ " + sum + " }\n}\n";
    // Others that are written like it, which hold nothing of it.
    const auto others = [&](const std::string& folder) {
        std::vector<std::pair<std::string, std::string>> files;
        for (const std::string name : {"Loans", "Rents", "Taxes"})
            files.push_back({folder + name + "-Seq.cpp",
                             "void " + name + "::execute(const double* rate, double* due, int days)\n{\n" + loop +
                                 "{ due[day] = rate[day] * 1.1; }\n" + loop + "{ due[day] = due[day] - 7; }\n" + loop +
                                 "{ due[day] *= due[day]; }\n}\n"});
        return files;
    };
    const auto count = [&](const std::string& source, const std::string& target, const std::string& text) {
        auto files = others("bank/");
        files.push_back({target, text});
        size_t held = 0;
        for (const auto& [from, to] : pairs(match({{source, steps}}, files))) held += to.starts_with(target) ? 1 : 0;
        return held;
    };
    EXPECT_EQ(count("bank/Trades-Cuda.cu", "bank/Trades-Seq.cpp", holder), 3u);
    EXPECT_LE(count("bank/Notes-Cuda.cu", "other/Trades-Seq.cpp", holder), 1u) << "nothing says that it is theirs";
    EXPECT_LE(count("bank/Trades-Cuda.cu", "bank/Trades-Seq.cpp",
                    "void Trades::execute(const double* price, double* gain, int days)\n{\n" + loop + "{ " + rise +
                        " }\n}\n"),
              1u)
        << "it holds one of them alone";
}

/// A project that has its functions in two forms, the second under names of its own: one word more throughout a file.
TEST(Match, AFamilyInASecondFormIsPortedByBoth) {
    const std::vector<std::string> names = {"reverse", "rotate", "append", "purge", "mirror", "title"};
    const auto family = [&](const std::string& prefix, const std::string& type, size_t count) {
        std::string out;
        for (size_t i = 0; i < count; ++i)
            out += "int " + prefix + names[i] + "(" + type +
                   "* word, int n) { for (int i = 0; i < n; ++i) word[i] = " + names[i] + "_of(word, i); return n; }\n";
        return out;
    };
    const auto ports = [&](size_t in_second_form) {
        size_t count = 0;
        for (const auto& [source, target] :
             pairs(match({{"c/words.c", family("word_", "char", 6)}},
                         {{"cl/words.cl", family("word_", "uchar", 6)},
                          {"cl/fast.cl", family("rule_op_word_", "uint", in_second_form)}})))
            count += target.starts_with("cl/fast.cl") ? 1 : 0;
        return count;
    };
    EXPECT_EQ(ports(6), 6u);
    EXPECT_EQ(ports(3), 0u) << "three are no family";
}

TEST(Match, OneFunctionIsPortedBySeveralKernels) {
    const auto kernel = [](const std::string& name, const std::string& type) {
        return "__kernel void kernel_" + name + "(__global " + type + "* x, __global " + type +
               "* y) {\n  int i = get_global_id(0);\n  y[i] = tanh(x[i]) * x[i] + 0.5f;\n}\n";
    };
    const Matching got = match(
        {{"c/mish.c",
          "void op_mish(const float* x, float* y, int n) {\n  for (int i = 0; i < n; ++i) y[i] = tanhf(x[i]) * x[i] "
          "+ 0.5f;\n}\n"}},
        {{"cl/mish.cl", kernel("mish_f32", "float") + kernel("mish_f16", "half") + kernel("mash_f16", "half")}});
    EXPECT_EQ(pairs(got), (Pairs{{"c/mish.c:op_mish", "cl/mish.cl:kernel_mish_f16"},
                                 {"c/mish.c:op_mish", "cl/mish.cl:kernel_mish_f32"}}));
}

TEST(Match, AVariantOfASettledSourceSharesItsTarget) {
    const auto kernel = [](const std::string& name, const std::string& type) {
        return "__kernel void kernel_" + name + "(__global " + type + "* x, __global " + type +
               "* y) {\n  int i = get_global_id(0);\n  y[i] = tanh(x[i]) * x[i] + 0.5f;\n}\n";
    };
    Settled settled;
    settled.pairs = {{"cl/mish.cl:kernel_mish_f32", "c/other.c:activation"}};
    const std::vector<std::pair<std::string, std::string>>
        source = {{"cl/mish.cl", kernel("mish_f32", "float") + kernel("mish_f16", "half")}},
        target = {{"c/other.c",
                   "void activation(const float* x, float* y, int n) {\n  for (int i = 0; i < n; ++i) y[i] = "
                   "tanhf(x[i]) * x[i] + 0.5f;\n}\n"}};
    EXPECT_EQ(match(source, target, settled).pairs.size(), 1u);
    settled.shares = true;
    const Matching got = match(source, target, settled);
    EXPECT_EQ(pairs(got), (Pairs{{"cl/mish.cl:kernel_mish_f16", "c/other.c:activation"},
                                 {"cl/mish.cl:kernel_mish_f32", "c/other.c:activation"}}));
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

/// Of several programs each has its ports in its own folder; a helper that one lacks there is not ported by another's.
TEST(Match, AHelperIsNotPortedByThatOfAnotherProgram) {
    const auto step = [](const std::string& name, int k) {
        const std::string n = std::to_string(k);
        return "void " + name + "_step" + n + "(float* a, int n) {\n    for (int i = " + n +
               "; i < n; ++i) a[i] = a[i - " + n + "] * " + name + "_scale + " + n + ".5f;\n}\n";
    };
    const auto program = [&](const std::string& name) {
        return step(name, 1) + step(name, 2) + step(name, 3) + step(name, 4);
    };
    const std::string own =
        "int take_sum(const int* a, int n) {\n    int s = 0;\n    for (int i = 0; i < n; ++i) s += a[i];\n"
        "    return s;\n}\n";
    const auto scores = [&](const std::string& there) {
        std::map<std::string, float> out;
        for (const MatchedPair& pair :
             match(
                 {{"warp/cuda/k.cu", program("warp")},
                  {"warp/cuda/io.h", own},
                  {"blur/cuda/k.cu", program("blur")},
                  {"blur/cuda/io.h", there}},
                 {{"warp/sycl/k.cpp", program("warp")}, {"blur/sycl/k.cpp", program("blur")}, {"blur/sycl/io.h", own}})
                 .pairs)
            out[pair.source + "=" + pair.target] = pair.score;
        return out;
    };
    for (const auto& [pair, score] : scores(own))
        EXPECT_EQ(pair.substr(0, 4), pair.substr(pair.find('=') + 1, 4)) << pair << " " << score;
    const auto alone = scores("");
    ASSERT_TRUE(alone.contains("warp/cuda/io.h:take_sum=blur/sycl/io.h:take_sum")) << "the only one that there is";
    EXPECT_LT(alone.at("warp/cuda/io.h:take_sum=blur/sycl/io.h:take_sum"), 0.9f);
    EXPECT_EQ(scores(own).size(), 9u);
}

TEST(Match, IsFastAndGrowsGently) {
    const auto seconds = [](size_t functions) {
        const auto source = many(functions, false), target = many(functions, true);
        const auto start = std::chrono::steady_clock::now();
        const Matching got = match(source, target);
        EXPECT_GT(got.pairs.size(), functions * 95 / 100);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const double small = seconds(1000 / testing::kLighter);
    const double large = seconds(8000 / testing::kLighter);  // 8,000 + 8,000 functions of 8 lines: 128,000 lines
    EXPECT_LT(large, 16 * small + 1.0);
    RecordProperty("seconds_for_128000_lines", std::to_string(large));
}

/// Files of one side: path and text.
using Texts = std::vector<std::pair<std::string, std::string>>;

/// One solver for an API, with a helper that its class or its file holds; `only` is a function that no other has.
std::string solver(const std::string& api, const std::string& loop, const std::string& only) {
    return "class " + api + "Solver {\npublic:\n" + api + "Solver(int n) : n_(n) { prepare(n); }\n~" + api +
           "Solver() { release(); }\nvoid smooth(float* x, const float* b, int n) { " + loop +
           " x[i] = 0.5f * (x[i] + b[i]); }\nfloat residual(const float* x, const float* b, int n) { float r = 0; " +
           loop +
           " r += (b[i] - x[i]) * (b[i] - x[i]); return r; }\nvoid restrict_grid(const float* fine, float* coarse, int "
           "n)"
           " { " +
           loop +
           " coarse[i] = 0.25f * fine[2 * i] + 0.75f * fine[2 * i + 1]; }\nprivate:\nint n_;\n};\n"
           "static float limit(float v, float most) { return v > most ? most : v; }\n"
           "void " +
           only + "(int* p, int n) { " + loop + " p[i] = n - i; }\n";
}

const Texts& ports_of_solver() {
    static const Texts ports = {
        {"src/cuda/solver.cu", solver("Cuda", "for (int i = begin(n); i < n; i += step())", "check_error")},
        {"src/omp/solver.cpp", solver("Omp", "#pragma omp parallel for\nfor (int i = 0; i < n; i++)\n", "set_threads")},
        {"src/tbb/solver.cpp", solver("Tbb", "for (auto i : range(n))", "pick_partitioner")},
        {"src/acc/solver.cpp", solver("Acc", "#pragma acc loop\nfor (int i = 0; i < n; ++i)\n", "upload_all")},
        {"src/kokkos/solver.cpp", solver("Kokkos", "for (int i : policy(n))", "make_view")}};
    return ports;
}

const Texts& serial_solver() {
    static const Texts source = {
        {"src/serial/solver.cpp", solver("Serial", "for (int i = 0; i < n; ++i)", "tell_host")}};
    return source;
}

TEST(Ports, ManyFoldersInOneTargetGiveThePairsThatEachGivesAlone) {
    Pairs alone;
    for (const auto& port : ports_of_solver()) {
        const Pairs found = pairs(match(serial_solver(), {port}));
        EXPECT_GE(found.size(), 5u) << port.first;
        alone.insert(alone.end(), found.begin(), found.end());
    }
    std::sort(alone.begin(), alone.end());
    const Matching all = match(serial_solver(), ports_of_solver());
    EXPECT_EQ(pairs(all), alone);
    EXPECT_EQ(all.ports, (std::vector<std::string>{"acc", "cuda", "kokkos", "omp", "tbb"}));
}

TEST(Ports, AWordOfTheFolderTellsThemApart) {
    Texts source, target;
    for (const std::string program : {"heat", "sort", "scan", "walk"}) {
        const std::string text = "void " + program + "_step(float* p, int n) { for (int i = 0; i < n; ++i) p[i] += " +
                                 std::to_string(program.size() + program[0]) + "; }\nint main() { " + program +
                                 "_step(data(), 8); return " + program + "_check(); }\nint " + program +
                                 "_check() { return data()[0] > 1; }\n";
        source.emplace_back(program + "-cuda/main.cu", text);
        for (const std::string api : {"hip", "omp", "sycl"})
            target.emplace_back(program + "-" + api + "/main.cpp", text);
    }
    const Matching all = match(source, target);
    EXPECT_EQ(all.ports, (std::vector<std::string>{"hip", "omp", "sycl"}));
    EXPECT_EQ(all.pairs.size(), 36u);
    for (const auto& [from, to] : pairs(all)) EXPECT_EQ(from.substr(0, 4), to.substr(0, 4));
}

/// The modules of one port, and the programs of a collection: neither has what another has.
TEST(Ports, ModulesAndProgramsAreOnePort) {
    Texts source, target;
    for (const std::string module : {"heat", "sort", "scan"}) {
        std::string text;
        for (const std::string part : {"first", "inner", "last"})
            text +=
                "void " + module + "_" + part + "(float* p) { p[0] = " + std::to_string(module[0] + part[0]) + "; }\n";
        for (const std::string shared : {"init", "run", "main"})
            text += "int " + shared + "() { return " + module + "_" + shared + "_status(); }\n";
        source.emplace_back("gpu/" + module + "/main.cu", text);
        target.emplace_back("cpu/" + module + "/main.cpp", text);
    }
    EXPECT_TRUE(match(source, target).ports.empty());
}

TEST(Ports, WhatTheyHaveInCommonIsPairedOnce) {
    Texts source = serial_solver(), target = ports_of_solver();
    const std::string text =
        "float parse_tolerance(const char* text) { return text ? read_number(text) * 0.1f : 1e-6f; }\n";
    source.emplace_back("src/serial/input.cpp", text);
    target.emplace_back("src/common/input.cpp", text);
    const Pairs found = pairs(match(source, target));
    EXPECT_EQ(std::count_if(found.begin(), found.end(),
                            [](const auto& pair) { return pair.first.ends_with("parse_tolerance"); }),
              1);
}

/// What a person has settled of one port stays, and says nothing of the others.
TEST(Ports, SettledPairsCountInTheirOwn) {
    const Settled settled{{{"src/serial/solver.cpp:limit", "src/omp/solver.cpp:set_threads"}}, {}, true};
    const Pairs found = pairs(match(serial_solver(), ports_of_solver(), settled));
    const auto has = [&](const std::string& target) {
        return std::count(found.begin(), found.end(),
                          std::pair<std::string, std::string>("src/serial/solver.cpp:limit", target));
    };
    EXPECT_EQ(has("src/omp/solver.cpp:set_threads"), 1);
    EXPECT_EQ(has("src/omp/solver.cpp:limit"), 0);
    EXPECT_EQ(has("src/tbb/solver.cpp:limit"), 1);
}

/// The host that calls a kernel's launcher is in the target's folder: it is no port of the kernel.
TEST(Match, WhatCallsTheLauncherBesideAKernelIsNotItsPort) {
    const std::string loop = "float f = k[0] * (x[i] - x[i + 1]); out[i] += f; e[i] += 0.5f * f * f; ";
    const std::string kernel =
        "__global__ void gpu_bond_forces_kernel(float* out, float* e, const float* x, const float* k, int n) {"
        " int i = blockIdx.x * blockDim.x + threadIdx.x; if (i >= n) return; " +
        loop +
        "}\n"
        "void gpu_bond_forces(float* out, float* e, const float* x, const float* k, int n) {"
        " gpu_bond_forces_kernel<<<n / 64, 64>>>(out, e, x, k, n); }\n";
    const std::string host =
        "void BondForceGPU::bondForces(int n) { Handle out(m_out), e(m_e), x(m_x), k(m_k);"
        " gpu_bond_forces(out.data, e.data, x.data, k.data, n); }\n";
    const std::string cpu =
        "void bond_forces(float* out, float* e, const float* x, const float* k, int n) {"
        " for (int i = 0; i < n; ++i) { " +
        loop + "} }\n";
    for (const auto& [from, to] : pairs(match({{"md/bond_gpu.cu", kernel}}, {{"md/bond_gpu.cc", host}})))
        ADD_FAILURE() << from << " = " << to;
    const Pairs expected = {{"md/bond_gpu.cu:gpu_bond_forces_kernel", "md/bond.cc:bond_forces"}};
    EXPECT_EQ(pairs(match({{"md/bond_gpu.cu", kernel}}, {{"md/bond_gpu.cc", host}, {"md/bond.cc", cpu}})), expected);
}

TEST(Match, CopiesInNumberedFilesGoByTheirNumbers) {
    EXPECT_EQ(number_in("m25600-pure"), 25600);
    EXPECT_EQ(number_in("module_00500"), 500);
    EXPECT_EQ(number_in("conv_2d"), 0);
    EXPECT_EQ(number_in("m100_200"), 0);
    std::vector<std::pair<std::string, std::string>> source, target;
    Pairs expected;
    const std::string text = "struct hash_tmp { unsigned int e[18]; unsigned int p[18]; unsigned int s0[256]; };\n";
    for (const std::string number : {"03200", "25600", "25800", "28400", "30600"}) {
        source.emplace_back("cl/m" + number + "-pure.cl", text);
        target.emplace_back("src/module_" + number + ".c", text);
        expected.emplace_back("cl/m" + number + "-pure.cl:hash_tmp", "src/module_" + number + ".c:hash_tmp");
    }
    EXPECT_EQ(pairs(match(source, target)), expected);
}

TEST(Match, ADestructorIsNoConstructorsPort) {
    const std::string rest = "int size() { return n_; }\n int n_; };\n";
    for (const auto& [from, to] :
         pairs(match({{"s/a.cpp", "class Field { public: ~Field() { drop(p_, n_); }\n" + rest}},
                     {{"t/a.cpp", "class Field { public: Field() { drop(p_, n_); }\n" + rest}})))
        EXPECT_FALSE(from.ends_with("~Field")) << to;
}

}  // namespace
}  // namespace porttool::match_test
