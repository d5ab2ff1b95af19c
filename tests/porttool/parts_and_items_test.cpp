// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What one side says once for a vector or a thread's item, and the other for each part or in a loop over the items.
#include <gtest/gtest.h>

#include "porttool/scan/side.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::parts_and_items_test {
namespace {

/// The edit of both sides of a pair: each puts `now` in the place of `before`, wherever that stands.
struct Replaced {
    std::string what;
    BySide<std::pair<std::string, std::string>> edit;
    bool in_step;
};

struct SidesOfPair {
    std::string source_file, source, target_file, target;
};

std::string everywhere(std::string text, const std::pair<std::string, std::string>& edit) {
    EXPECT_NE(text.find(edit.first), std::string::npos) << edit.first;
    for (size_t at = 0; (at = text.find(edit.first, at)) != std::string::npos; at += edit.second.size())
        text.replace(at, edit.first.size(), edit.second);
    return text;
}

void expect_all(const SidesOfPair& pair, const std::vector<Replaced>& rows) {
    for (const Replaced& row : rows) {
        SCOPED_TRACE(pair.source_file + ": " + row.what);
        MemoryDisk disk;
        disk.files = {{"/r/s/" + pair.source_file, pair.source},
                      {"/r/t/" + pair.target_file, pair.target},
                      {"/r/portmap.toml",
                       "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n[[pair]]\nsource = \"s/" +
                           pair.source_file + ":f\"\ntarget = \"t/" + pair.target_file + ":f\"\n"}};
        ASSERT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
        disk.files["/r/s/" + pair.source_file] = everywhere(pair.source, row.edit.source);
        disk.files["/r/t/" + pair.target_file] = everywhere(pair.target, row.edit.target);
        const nlohmann::json report = check(disk);
        std::vector<std::string> rules;
        for (const auto& finding : report["findings"])
            if (finding["level"] == "error") rules.push_back(finding["rule"]);
        EXPECT_EQ(rules, row.in_step ? std::vector<std::string>{} : std::vector<std::string>{"port-differs"})
            << report.dump(1);
    }
}

const std::string kHostLoop =
    "void f(const std::vector<float>& in, std::vector<float>& out, float k) {\n"
    "    for (size_t i = 0; i < in.size(); ++i) {\n"
    "        float v = in[i];\n"
    "        out[i] = std::exp(-v * k) * 0.5f;\n"
    "    }\n"
    "}\n";

TEST(PartsAndItems, WhatEndsOneItemInAKernelGoesOnWithTheNextInALoop) {
    const std::string body =
        "    if (i >= n) return;\n"
        "    float v = a[i];\n"
        "    b[i] = exp(-v * k) * 0.5f;\n"
        "}\n";
    const std::vector<std::pair<std::string, std::string>> kernels = {
        {"k.cl",
         "__kernel void f(__global const float* a, __global float* b, int n, float k) {\n    int i = "
         "get_global_id(0);\n"},
        {"k.cu",
         "__global__ void f(const float* a, float* b, int n, float k) {\n"
         "    int i = blockIdx.x * blockDim.x + threadIdx.x;\n"},
        {"k.metal",
         "kernel void f(device const float* a, device float* b, constant int& n, constant float& k,\n"
         "              uint i [[thread_position_in_grid]]) {\n"},
        {"k.hip",
         "__global__ void f(const float* a, float* b, int n, float k) {\n"
         "    int i = blockIdx.x * blockDim.x + threadIdx.x;\n"}};
    const std::pair<std::string, std::string> in_kernel = {"float v = a[i];", "float v = a[i]; if (v < 0.0f) return;"};
    const auto in_port = [](const std::string& ends) {
        return std::pair<std::string, std::string>("float v = in[i];", "float v = in[i]; if (v < 0.0f) " + ends);
    };
    for (const auto& [file, head] : kernels)
        expect_all({file, head + body, "k.cpp", kHostLoop},
                   {{"the next item", {in_kernel, in_port("continue;")}, true},
                    {"no item any more", {in_kernel, in_port("return;")}, false},
                    {"an item's end at another condition", {in_kernel, in_port("{} if (v > 0.0f) continue;")}, false},
                    {"none", {in_kernel, in_port("{}")}, false}});
}

TEST(PartsAndItems, ALoopOfBothSidesIsLeftByBoth) {
    const std::string text =
        "void f(const float* a, float* b, int n) {\n"
        "    for (int i = 0; i < n; ++i) {\n"
        "        float v = a[i];\n"
        "        b[i] = v * 0.5f;\n"
        "    }\n"
        "}\n";
    const auto with = [](const std::string& ends) {
        return std::pair<std::string, std::string>("float v = a[i];", "float v = a[i]; if (v < 0.0f) " + ends);
    };
    expect_all({"k.cu", "__device__ " + text, "k.cpp", text},
               {{"both go on", {with("continue;"), with("continue;")}, true},
                {"both return", {with("return;"), with("return;")}, true},
                {"one returns", {with("return;"), with("continue;")}, false},
                {"the other returns", {with("continue;"), with("return;")}, false}});
}

TEST(PartsAndItems, TheBodyOfALambdaIsAFunctionOfItsOwn) {
    const std::string kernel =
        "__global__ void f(const float* a, float* b, int n) {\n"
        "    int i = blockIdx.x * blockDim.x + threadIdx.x;\n"
        "    float v = a[i];\n"
        "    b[i] = v * 0.5f;\n"
        "}\n";
    const std::string port =
        "void f(const float* a, float* b, int n) {\n"
        "    for (int pass = 0; pass < 1; ++pass)\n"
        "        run(n, [&](int i) {\n"
        "            float v = a[i];\n"
        "            b[i] = v * 0.5f;\n"
        "        });\n"
        "}\n";
    const std::pair<std::string, std::string> ends = {"float v = a[i];", "float v = a[i]; if (v < 0.0f) return;"};
    expect_all({"k.cu", kernel, "k.cpp", port}, {{"the lambda's return", {ends, ends}, true}});
}

TEST(PartsAndItems, AVectorHeldAgainstItsParts) {
    const SidesOfPair pair = {"k.cl",
                              "__kernel void f(__global const float2* a, __global float2* out, float k) {\n"
                              "    int i = get_global_id(0);\n"
                              "    float2 q = a[i] * k - 0.5f;\n"
                              "    out[i] = q * 2.0f;\n"
                              "}\n",
                              "k.c",
                              "void f(const float *a, float *out, int n, float k) {\n"
                              "    for (int i = 0; i < n; i++) {\n"
                              "        float qx = a[2 * i] * k - 0.5f;\n"
                              "        float qy = a[2 * i + 1] * k - 0.5f;\n"
                              "        out[2 * i] = qx * 2.0f;\n"
                              "        out[2 * i + 1] = qy * 2.0f;\n"
                              "    }\n"
                              "}\n"};
    const std::pair<std::string, std::string> whole = {"q * 2.0f", "q * 4.0f"};
    expect_all(
        pair,
        {{"one part", {whole, {"qx * 2.0f", "qx * 4.0f"}}, false},
         {"the other", {whole, {"qy * 2.0f", "qy * 4.0f"}}, false},
         {"both", {whole, {" * 2.0f", " * 4.0f"}}, true},
         {"both, to another number", {whole, {" * 2.0f", " * 8.0f"}}, false},
         {"both, one to another number",
          {whole, {"qx * 2.0f;\n        out[2 * i + 1] = qy * 2.0f", "qx * 4.0f;\n        out[2 * i + 1] = qy * 8.0f"}},
          false},
         {"both, in each other's place",
          {whole, {"qx * 2.0f;\n        out[2 * i + 1] = qy * 2.0f", "qy * 4.0f;\n        out[2 * i + 1] = qx * 4.0f"}},
          false},
         {"both from the first",
          {whole, {"qx * 2.0f;\n        out[2 * i + 1] = qy * 2.0f", "qx * 4.0f;\n        out[2 * i + 1] = qx * 4.0f"}},
          false},
         {"both into one place",
          {whole, {"qx * 2.0f;\n        out[2 * i + 1] = qy * 2.0f", "qx * 4.0f;\n        out[2 * i] = qy * 4.0f"}},
          false},
         {"a sign, one part", {{"k - 0.5f", "k + 0.5f"}, {"a[2 * i] * k - ", "a[2 * i] * k + "}}, false},
         {"a sign, both", {{"k - 0.5f", "k + 0.5f"}, {" * k - ", " * k + "}}, true}});
}

TEST(PartsAndItems, ALoopOverPartsHeldAgainstThese) {
    const SidesOfPair pair = {
        "k.ispc",
        "export void f(uniform float ax[], uniform float ay[], uniform float az[], uniform int n,\n"
        "              uniform float k) {\n"
        "    foreach (i = 0 ... n) {\n"
        "        ax[i] = ax[i] * k;\n"
        "        ay[i] = ay[i] * k;\n"
        "        az[i] = az[i] * k;\n"
        "    }\n"
        "}\n",
        "k.c",
        "void f(float (*acc)[3], int n, float k) {\n"
        "    for (int i = 0; i < n; i++)\n"
        "        for (int c = 0; c < 3; c++) acc[i][c] = acc[i][c] * k;\n"
        "}\n"};
    const std::pair<std::string, std::string> loop = {"* k;", "* k * 2.0f;"};
    expect_all(pair, {{"one part", {{"ay[i] * k", "ay[i] * k * 2.0f"}, loop}, false},
                      {"all", {{"* k;", "* k * 2.0f;"}, loop}, true},
                      {"all, to another number", {{"* k;", "* k * 3.0f;"}, loop}, false}});
}

TEST(PartsAndItems, APartThatBothSidesNameIsOfThatPartAlone) {
    const SidesOfPair pair = {"k.cu",
                              "__device__ void f(float3 v, float k) {\n"
                              "    float d = v.x * k + v.y;\n"
                              "    g(d, v.y * k);\n"
                              "}\n",
                              "k.cpp",
                              "void f(vec v, float k) {\n"
                              "    float ax = v.x * k + v.y;\n"
                              "    float ay = v.y * k + v.z;\n"
                              "    g(ax, ay, v.y * k);\n"
                              "}\n"};
    expect_all(pair, {{"x", {{"v.x * k", "v.x / k"}, {"v.x * k", "v.x / k"}}, true}});
}

/// An edit that puts a statement behind `at` on both sides.
Replaced behind(const std::string& what, const std::string& at, const std::string& in_source,
                const std::string& in_target, bool in_step) {
    return {what, {{at, at + " " + in_source}, {at, at + " " + in_target}}, in_step};
}

TEST(PartsAndItems, AReturnFromWithinMoreLoopsEndsMore) {
    const std::string inner = "for (int k = 0; k < m; ++k) { x = x * w[k]; p[i] = x; }";
    const SidesOfPair pair = {"k.cu",
                              "__global__ void f(float* p, const float* w, int n, int m, float k0) {\n"
                              "    int i = blockIdx.x * blockDim.x + threadIdx.x;\n    if (i >= n) return;\n"
                              "    float x = p[i];\n    " +
                                  inner + "\n}\n",
                              "k.cpp",
                              "void f(float* p, const float* w, int n, int m, float k0) {\n"
                              "    for (int i = 0; i < n; ++i) {\n        float x = p[i];\n        " +
                                  inner + "\n    }\n}\n"};
    const std::string at = "x = x * w[k];";
    expect_all(
        pair,
        {behind("both return", at, "if (x < k0) return;", "if (x < k0) return;", false),
         behind("the port goes on", at, "if (x < k0) return;", "if (x < k0) continue;", false),
         behind("both go on", at, "if (x < k0) continue;", "if (x < k0) continue;", true),
         behind("both break", at, "if (x < k0) break;", "if (x < k0) break;", true),
         behind("one breaks", at, "if (x < k0) break;", "if (x < k0) continue;", false),
         behind("before the loop", "float x = p[i];", "if (x < k0) return;", "if (x < k0) continue;", true),
         behind("a switch is left", "float x = p[i];", "switch (m) { case 1: return; case 2: x = k0; break; }",
                "switch (m) { case 1: break; case 2: x = k0; break; }", false),
         behind("an item ends in a switch", "float x = p[i];", "switch (m) { case 1: return; case 2: x = k0; break; }",
                "switch (m) { case 1: continue; case 2: x = k0; break; }", true)});
}

TEST(PartsAndItems, WhatGoesOnWithoutAStepGoesOnForever) {
    const std::string kernel =
        "__global__ void f(float* p, int n, float k) {\n    int i = blockIdx.x * blockDim.x + threadIdx.x;\n"
        "    if (i >= n) return;\n    float x = p[i];\n    p[i] = x * k;\n}\n";
    const auto port = [](const std::string& head, const std::string& step) {
        return "void f(float* p, int n, float k) {\n    int i = 0;\n    " + head +
               " {\n        float x = p[i];\n        p[i] = x * k;\n" + step + "    }\n}\n";
    };
    const auto expect = [&](const std::string& head, const std::string& step, const std::string& ends, bool in_step) {
        expect_all({"k.cu", kernel, "k.cpp", port(head, step)},
                   {behind(head + " " + step + " " + ends, "float x = p[i];", "if (x < k) return;",
                           "if (x < k) " + ends, in_step)});
    };
    expect("while (i < n)", "++i;", "continue;", false);
    expect("while (i < n)", "++i;", "{ ++i; continue; }", true);
    expect("while (i < n)", "i += 1;", "{ i += 1; continue; }", true);
    expect("while (i < n)", "i += 1;", "{ i += 2; continue; }", false);
    expect("while (i < n)", "++i; k += 2;", "{ k += 2; continue; }", false);
    expect("while (true)", "++i; if (i >= n) break;", "continue;", false);
    expect("for (; i < n;)", "++i;", "continue;", false);
    expect("for (; i < n; ++i)", "", "continue;", true);
    expect("while (++i < n)", "", "continue;", true);
    expect("while (next(i, n))", "", "continue;", true);
    expect("FOR_ITEMS(i, n)", "", "continue;", true);
    expect("FOR_ITEMS(i, n)", "", "return;", false);
    expect("for (int i : all)", "", "return;", false);
    expect("\n#pragma omp parallel for\n    for (; i < n; ++i)", "", "continue;", true);
    expect("\n#pragma omp parallel for\n    for (; i < n; ++i)", "", "return;", false);
    expect("\n#pragma unroll(4)\n    FOR_ITEMS(i, n)", "", "return;", false);
}

TEST(PartsAndItems, PartsGoByAnyName) {
    const std::string whole =
        "__device__ float3 f(float3 c, float k, float e, float m) {\n    c *= k;\n    c = c + e;\n    return c * "
        "m;\n}\n";
    for (const std::vector<std::string>& names : std::vector<std::vector<std::string>>{
             {"red", "green", "blue"}, {"lo", "mid", "hi"}, {"u", "v", "t"}, {"c0", "c1", "c2"}, {"cx", "cy", "cz"}}) {
        std::string port = "void f(float& " + names[0] + ", float& " + names[1] + ", float& " + names[2] +
                           ", float k, float e, float m) {\n";
        for (const std::string& part : names) port += "    " + part + " *= k;\n";
        for (const std::string& part : names) port += "    " + part + " = " + part + " + e;\n";
        for (const std::string& part : names) port += "    " + part + " = " + part + " * m;\n";
        const SidesOfPair pair = {"k.cu", whole, "k.cpp", port + "}\n"};
        const std::pair<std::string, std::string> edit = {"c *= k;", "c *= k * 0.5f;"};
        const auto of_part = [&](size_t i) {
            return std::pair<std::string, std::string>(names[i] + " *= k;", names[i] + " *= k * 0.5f;");
        };
        expect_all(pair, {{names[0] + " alone", {edit, of_part(0)}, false},
                          {names[1] + " alone", {edit, of_part(1)}, false},
                          {names[2] + " alone", {edit, of_part(2)}, false},
                          {"all of " + names[0], {edit, {" *= k;", " *= k * 0.5f;"}}, true},
                          {"all to another number", {edit, {" *= k;", " *= k * 0.25f;"}}, false},
                          {"all to another name", {edit, {" *= k;", " *= m * 0.5f;"}}, false}});
    }
}

TEST(PartsAndItems, PartsOfWhatCame) {
    const SidesOfPair pair = {
        "k.cu", "__device__ void f(float3& p, float3 e, float3 d, float m) {\n    p += e;\n    p *= d;\n}\n", "k.cpp",
        "void f(vec& p, vec e, vec d, float m) {\n"
        "    p.x += e.x;\n    p.y += e.y;\n    p.z += e.z;\n"
        "    p.x *= d.x;\n    p.y *= d.y;\n    p.z *= d.z;\n}\n"};
    const std::string was = "p.x += e.x;\n    p.y += e.y;\n    p.z += e.z;";
    const std::pair<std::string, std::string> edit = {"p += e;", "p += e * d;"};
    const auto to = [&](const std::string& x, const std::string& y, const std::string& z) {
        return std::pair<std::string, std::string>(
            was, "p.x += e.x * " + x + ";\n    p.y += e.y * " + y + ";\n    p.z += e.z * " + z + ";");
    };
    expect_all(pair, {{"each its own", {edit, to("d.x", "d.y", "d.z")}, true},
                      {"all the first's", {edit, to("d.x", "d.x", "d.x")}, false},
                      {"two of them changed places", {edit, to("d.x", "d.z", "d.y")}, false},
                      {"one forgotten", {edit, to("d.x", "d.y", "1.0f")}, false},
                      {"of another vector", {edit, to("p.x", "p.y", "p.z")}, false}});
}

TEST(PartsAndItems, OfLikeStatementsTheOneThatStandsForTheOther) {
    const SidesOfPair clamps = {"k.cu",
                                "__device__ float f(float left, float right, float lo, float hi) {\n"
                                "    left = clamp(left, lo, hi);\n    right = clamp(right, lo, hi);\n"
                                "    return left - right * 2.0f;\n}\n",
                                "k.cpp",
                                "float f(float one, float two, float lo, float hi) {\n"
                                "    one = std::min(std::max(one, lo), hi);\n    two = clamp(two, lo, hi);\n"
                                "    return one - two * 2.0f;\n}\n"};
    const std::pair<std::string, std::string> two = {"clamp(two, lo, hi)", "clamp(two, lo, 2.0f * hi)"};
    expect_all(clamps, {{"left", {{"clamp(left, lo, hi)", "clamp(left, lo, 2.0f * hi)"}, two}, false},
                        {"right", {{"clamp(right, lo, hi)", "clamp(right, lo, 2.0f * hi)"}, two}, true}});
    const SidesOfPair scaled = {"k.cu",
                                "__global__ void f(float* p, float* q, int i, float k) {\n"
                                "    float left = p[i] * k;\n    float right = q[i] * k;\n"
                                "    p[i] = left + 1.0f;\n    q[i] = right + 1.0f;\n}\n",
                                "k.cpp",
                                "void f(Body& body, float k) {\n"
                                "    float one = scaled(body.position, k);\n    float two = body.speed * k;\n"
                                "    body.position = one + 1.0f;\n    body.speed = two + 1.0f;\n}\n"};
    const std::pair<std::string, std::string> speed = {"speed * k", "speed * k * k"};
    expect_all(scaled, {{"left", {{"p[i] * k", "p[i] * k * k"}, speed}, false},
                        {"right", {{"q[i] * k", "q[i] * k * k"}, speed}, true}});
}

}  // namespace
}  // namespace porttool::testing::parts_and_items_test
