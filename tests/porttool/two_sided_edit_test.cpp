// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Edits that both sides made in the manner of their language, and structs and names that are told by what they are.
#include <gtest/gtest.h>

#include "porttool/scan/side.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::two_sided_edit_test {
namespace {

using Names = std::vector<std::string>;

struct TwoSided {
    std::string what, source_file, target_file;
    BySide<std::string> before, now;
    Names rules;
};

/// Records the texts before as in step and returns the report on the texts now. Units of one name are pairs.
nlohmann::json report_on(const TwoSided& row, const std::string& unit = "f") {
    MemoryDisk disk;
    disk.files = {{"/r/s/" + row.source_file, row.before.source},
                  {"/r/t/" + row.target_file, row.before.target},
                  {"/r/portmap.toml",
                   "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n[[pair]]\nsource = \"s/" +
                       row.source_file + ":" + unit + "\"\ntarget = \"t/" + row.target_file + ":" + unit + "\"\n"}};
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0) << row.what;
    disk.files["/r/s/" + row.source_file] = row.now.source;
    disk.files["/r/t/" + row.target_file] = row.now.target;
    return check(disk);
}

Names rules_of(const nlohmann::json& report) {
    Names out;
    for (const auto& finding : report["findings"])
        if (finding["level"] != "note" && finding["rule"] != "unported") out.push_back(finding["rule"]);
    return out;
}

/// What a stage of three calls, each side says in its own way; `more` comes with a fourth.
std::string stages(const std::string& call, const std::string& more) {
    const auto said = [&](const std::string& name) { return replaced(call, "@", name); };
    return "void f(int stage, int job, int n) { if (stage == 0) { " + said("first") + " } else if (stage == 1) { " +
           said("second") + " } else if (stage == 2) { " + said("third") + " }" +
           (more.empty() ? "" : " else if (stage == 3) { " + more + " }") + " }";
}

TEST(TwoSidedEdit, AStatementIsSaidAsAllOthersThatDifferInANameAre) {
    const std::string here = "@(job);", there = "each<@>(n);";
    const BySide<std::string> before{stages(here, ""), stages(there, "")};
    const auto now = [&](const std::string& source, const std::string& target) {
        return BySide<std::string>{stages(here, source), stages(there, target)};
    };
    const std::vector<TwoSided> rows = {
        {"the same name", "k.glsl", "k.cpp", before, now("fourth(job);", "each<fourth>(n);"), {}},
        {"another name", "k.glsl", "k.cpp", before, now("fourth(job);", "each<fifth>(n);"), {"port-differs"}},
        {"another argument here", "k.glsl", "k.cpp", before, now("fourth(n);", "each<fourth>(n);"), {"port-differs"}},
        {"another argument there",
         "k.glsl",
         "k.cpp",
         before,
         now("fourth(job);", "each<fourth>(job);"),
         {"port-differs"}},
        {"nothing there", "k.glsl", "k.cpp", before, now("fourth(job);", ""), {"source-changed"}},
    };
    for (const TwoSided& row : rows) EXPECT_EQ(rules_of(report_on(row)), row.rules) << row.what;
}

/// A function of five statements, with what stands in their midst on each side.
std::string five(const std::string& head, const std::string& midst) {
    return "void f(float* y, int n) { " + head + " open(y, n); " + midst + " shut(y, n); y[0] = 1.0f; }";
}

TEST(TwoSidedEdit, WhatIsLeftOfTwoEditsTellsHowMuchTheyCount) {
    const std::string a = "load(y); scale(y, n);", b = "Row row = rows.take(); row.bind(pool);";
    const auto level = [&](const std::string& source_now, const std::string& target_now, const std::string& there) {
        const TwoSided row{"", "k.cpp", "k.cpp", {five("", a), five("", there)}, {source_now, target_now}, {}};
        const auto report = report_on(row);
        if (report["findings"].empty()) return std::string("nothing");
        EXPECT_EQ(report["findings"][0]["rule"], "port-differs");
        return report["findings"][0]["level"].get<std::string>();
    };
    const std::string unlike = "Plan plan = planner.of(shape); plan.run(keys); plan.log(sink);";
    EXPECT_EQ(level(five("", "fetch_ahead(y, 4 * n, near); mix(y, n, far); settle(y, near);"), five("", unlike), b),
              "warning")
        << "nothing in common";
    // A slip in one edit of both is none of these.
    EXPECT_EQ(level(five("", "load(y); scale(y, 2 * n);"), five("", "load(y); scale(y, 3 * n);"), a), "error");
    EXPECT_EQ(level(five("", "load(y); scale(y, 2 * n); mark(y);"), five("", "load(y); scale(y, 2 * n); mark(n);"), a),
              "error");
    // The port did the same, and more.
    const std::string same = "load(y); scale(y, 2 * n);";
    EXPECT_EQ(level(five("", same), five("", same + " count(n); log(y, n); tell(y);"), a), "warning");
    EXPECT_EQ(level(five("", same), five("", same + " count(n);"), a), "error") << "a statement may be a slip";
    EXPECT_EQ(level(five("", same + " count(n); log(y, n); tell(y);"), five("", same), a), "error")
        << "what the source did more is owed";
}

TEST(TwoSidedEdit, InTheMannerOfEachLanguage) {
    const std::vector<TwoSided> rows = {
        {"HIP's names",
         "k.cu",
         "k.hip",
         {"void f(int n) { g(n); }", "void f(int n) { g(n); }"},
         {"void f(int n) { g(n); cudaMemset(p, 0, n); cublasCreate(&h); }",
          "void f(int n) { g(n); hipMemset(p, 0, n); hipblasCreate(&h); }"},
         {}},
        {"another call of HIP's",
         "k.cu",
         "k.hip",
         {"void f(int n) { g(n); }", "void f(int n) { g(n); }"},
         {"void f(int n) { g(n); cudaMemset(p, 0, n); }", "void f(int n) { g(n); hipMemsetAsync(p, 0, n); }"},
         {"port-differs"}},
        {"a method and a function",
         "k.cpp",
         "k.cl",
         {"void f(vec z) { r = 1.0; d = n[0].Dot(z); }", "void f(vec z) { r = 1.0; d = dot(n[0], z); }"},
         {"void f(vec z) { r = 1.0; r += n[0].Dot(z * 2); }", "void f(vec z) { r = 1.0; r += dot(n[0], z * 2); }"},
         {}},
        {"a method and the function of a type",
         "k.cl",
         "k.cpp",
         {"bool f() { return Color_IsBlack(a.b); }", "bool f() { return a.b.IsBlack(); }"},
         {"bool f() { return !Color_IsBlack(a.b) && c; }", "bool f() { return !a.b.IsBlack() && c; }"},
         {}},
        {"a method of another value",
         "k.cl",
         "k.cpp",
         {"bool f() { return Color_IsBlack(a.b); }", "bool f() { return a.b.IsBlack(); }"},
         {"bool f() { return Color_IsBlack(a.c); }", "bool f() { return a.d.IsBlack(); }"},
         {"port-differs"}},
        {"a number whose mark differs in that place alone",
         "k.cpp",
         "k.cl",
         {"void f() { double t = 0.0; t += 0.5 * a; }", "void f() { double t = 0.0f; t += 0.5 * a; }"},
         {"void f() { double t = 1.0; t += 0.5 * a; }", "void f() { double t = 1.0f; t += 0.5 * a; }"},
         {}},
        {"another number in that place",
         "k.cpp",
         "k.cl",
         {"void f() { double t = 0.0; t += 0.5 * a; }", "void f() { double t = 0.0f; t += 0.5 * a; }"},
         {"void f() { double t = 1.0; t += 0.5 * a; }", "void f() { double t = 2.0f; t += 0.5 * a; }"},
         {"port-differs"}},
        {"a mark that the other place has",
         "k.cpp",
         "k.cl",
         {"void f() { double t = 0.0; t += 0.5 * a; }", "void f() { double t = 0.0f; t += 0.5 * a; }"},
         {"void f() { double t = 0.0; t += 0.25 * a; }", "void f() { double t = 0.0f; t += 0.25f * a; }"},
         {"port-differs"}},
        {"an object and its members",
         "k.cl",
         "k.cpp",
         {"void f(__global Hit* hit) { hit->t = 1.0f; hit->u = 0.0f; }", "void f() { t = 1.0f; u = 0.0f; }"},
         {"void f(__global Hit* hit) { hit->t = 1.0f; hit->u = 0.0f; hit->v = 2.0f; }",
          "void f() { t = 1.0f; u = 0.0f; v = 2.0f; }"},
         {}},
        {"this",
         "k.cl",
         "k.cpp",
         {"void f(__global Hit* hit) { hit->t = 1.0f; }", "void f() { this->t = 1.0f; t = t; }"},
         {"void f(__global Hit* hit) { hit->t = 2.0f; }", "void f() { this->t = 2.0f; t = t; }"},
         {}},
        {"another member",
         "k.cl",
         "k.cpp",
         {"void f(__global Hit* hit) { hit->t = 1.0f; hit->u = 0.0f; }", "void f() { t = 1.0f; u = 0.0f; }"},
         {"void f(__global Hit* hit) { hit->t = 1.0f; hit->u = 0.0f; hit->v = 2.0f; }",
          "void f() { t = 1.0f; u = 0.0f; w = 2.0f; }"},
         {"port-differs"}},
        {"a local of the member's name",
         "k.cl",
         "k.cpp",
         {"void f(__global Hit* hit) { float t = 0.0f; hit->t = t; }", "void f() { float t = 0.0f; g(t); }"},
         {"void f(__global Hit* hit) { float t = 0.0f; hit->t = t; hit->t = 2.0f; }",
          "void f() { float t = 0.0f; g(t); t = 2.0f; }"},
         {"port-differs"}},
        {"components",
         "k.cl",
         "k.cpp",
         {"void f(float4 v) { g(v.x); }", "void f(float4 v) { g(v[0]); }"},
         {"void f(float4 v) { g(v.x); g(v.s1 + v.z); }", "void f(float4 v) { g(v[0]); g(v.y + v[2]); }"},
         {}},
        {"another component",
         "k.cl",
         "k.cpp",
         {"void f(float4 v) { g(v.x); }", "void f(float4 v) { g(v[0]); }"},
         {"void f(float4 v) { g(v.x); g(v.s1); }", "void f(float4 v) { g(v[0]); g(v[2]); }"},
         {"port-differs"}},
        {"NULL and cl_float",
         "k.cl",
         "k.cpp",
         {"void f(int n) { g(n); }", "void f(int n) { g(n); }"},
         {"void f(int n) { g(n); float x = h(NULL); }", "void f(int n) { g(n); cl_float x = h(nullptr); }"},
         {}},
        {"eight numbers, and eight bits",
         "k.cl",
         "k.cpp",
         {"void f(int n) { g(n); }", "void f(int n) { g(n); }"},
         {"void f(int n) { g(n); int8 x = h(n); }", "void f(int n) { g(n); int8_t x = h(n); }"},
         {"port-differs"}},
        {"eight bits",
         "k.ispc",
         "k.cpp",
         {"void f(int n) { g(n); }", "void f(int n) { g(n); }"},
         {"void f(int n) { g(n); int8 x = h(n); }", "void f(int n) { g(n); int8_t x = h(n); }"},
         {}},
        {"fma",
         "k.cl",
         "k.cpp",
         {"float f(float a) { return a; }", "float f(float a) { return a; }"},
         {"float f(float a) { return fma(a, a, a); }", "float f(float a) { return fmaf(a, a, a); }"},
         {}},
        {"mad is rounded otherwise",
         "k.cl",
         "k.cpp",
         {"float f(float a) { return a; }", "float f(float a) { return a; }"},
         {"float f(float a) { return mad(a, a, a); }", "float f(float a) { return fma(a, a, a); }"},
         {"port-differs"}},
        {"one side's hints",
         "k.cu",
         "k.cpp",
         {"void f(float* a) { for (int i = 0; i < 4; ++i) a[i] = 0.0f; }",
          "void f(float* a) { for (int i = 0; i < 4; ++i) a[i] = 0.0f; }"},
         {"void f(float* a) {\n#pragma unroll\nfor (int i = 0; i < 8; ++i) a[i] = 0.0f; }",
          "void f(float* a) { for (int i = 0; i < 8; ++i) a[i] = 0.0f; }"},
         {}},
        {"a macro for inlining on one side",
         "k.cl",
         "k.cpp",
         {"float f(float a) { return a; }", "float f(float a) { return a; }"},
         {"OUR_FORCE_INLINE float f(float a, float b) { return a * b; }",
          "float f(float a, float b) { return a * b; }"},
         {}},
        {"threads and groups",
         "k.cu",
         "k.cl",
         {"void f() { g(1); }", "void f() { g(1); }"},
         {"void f() { g(1); g(threadIdx.x + blockIdx.y * 2); g(blockDim.z); g(blockIdx.x * blockDim.x + threadIdx.x); "
          "}",
          "void f() { g(1); g(get_local_id(0) + get_group_id(1) * 2); g(get_local_size(2)); g(get_global_id(0)); }"},
         {}},
        {"a barrier of an object",
         "k.cu",
         "k.cpp",
         {"void f(int* a) { g(a); h(a); }", "void f(int* a, item& i) { g(a); h(a); }"},
         {"void f(int* a) { g(a); __syncthreads(); h(a); }",
          "void f(int* a, item& i) { g(a); i.barrier(sycl::access::fence_space::local_space); h(a); }"},
         {}},
        {"a barrier of all memory",
         "k.cu",
         "k.cpp",
         {"void f(int* a) { g(a); h(a); }", "void f(int* a, item& i) { g(a); h(a); }"},
         {"void f(int* a) { g(a); __syncthreads(); h(a); }",
          "void f(int* a, item& i) { g(a); i.barrier(sycl::access::fence_space::global_space); h(a); }"},
         {"port-differs"}},
        {"a port that says double here and REAL elsewhere",
         "k.cpp",
         "k.cl",
         {"void f() { double a = 1.0; double b = a; double c = b; double d = c; }",
          "void f() { REAL a = 1.0f; REAL b = a; REAL c = b; double d = c; }"},
         {"void f() { double a = 1.0; double b = a; double c = b; double d = c; double e = d; }",
          "void f() { REAL a = 1.0f; REAL b = a; REAL c = b; double d = c; REAL e = d; }"},
         {}},
        {"what it gives back, and a parameter",
         "k.cl",
         "k.cpp",
         {"REAL4 f(REAL4 z) { z = g(z); return z; }", "void f(Vector& z) { z = g(z); return z; }"},
         {"REAL4 f(REAL4 z) { REAL4 old = z; z = g(old); return z; }",
          "void f(Vector& z) { Vector old = z; z = g(old); return z; }"},
         {}},
        {"a pragma that stands before a statement",
         "k.cpp",
         "k.cu",
         {"void f(int* a) {\n#pragma omp target enter data map(to: a[0:4])\n  g(a); h(a); }",
          "void f(int* a) { g(a); h(a); }"},
         {"void f(int* a) {\n#pragma omp target enter data map(to: a[0:4])\n  g(a + 1); h(a); }",
          "void f(int* a) { g(a + 1); h(a); }"},
         {}},
        {"another axis",
         "k.cu",
         "k.cl",
         {"void f() { g(1); }", "void f() { g(1); }"},
         {"void f() { g(1); g(threadIdx.x); }", "void f() { g(1); g(get_local_id(1)); }"},
         {"port-differs"}},
        {"two axes are no thread's number",
         "k.cu",
         "k.cl",
         {"void f() { g(1); }", "void f() { g(1); }"},
         {"void f() { g(1); g(blockIdx.x * blockDim.y + threadIdx.x); }", "void f() { g(1); g(get_global_id(0)); }"},
         {"port-differs"}},
        {"a factor before it",
         "k.cu",
         "k.cl",
         {"void f() { g(1); }", "void f() { g(1); }"},
         {"void f() { g(1); g(2 * blockIdx.x * blockDim.x + threadIdx.x); }",
          "void f() { g(1); g(2 * get_global_id(0)); }"},
         {"port-differs"}},
        {"a conversion to the type that is declared",
         "k.cu",
         "k.comp",
         {"void f() { g(1); }", "void f() { g(1); }"},
         {"void f() { g(1); int i = threadIdx.x; }", "void f() { g(1); int i = int(gl_LocalInvocationID.x); }"},
         {}},
        {"vectors of one value",
         "k.cu",
         "k.cl",
         {"void f(float a) { g(a); }", "void f(float a) { g(a); }"},
         {"void f(float a) { g(a); g(make_float4(a, a, a, a)); }", "void f(float a) { g(a); g((float4)(a)); }"},
         {}},
        {"vectors of two values",
         "k.cu",
         "k.glsl",
         {"void f(float a) { g(a); }", "void f(float a) { g(a); }"},
         {"void f(float a) { g(a); g(make_float3(a, a, b)); }", "void f(float a) { g(a); g(vec3(a)); }"},
         {"port-differs"}},
        {"swizzles",
         "k.cu",
         "k.glsl",
         {"void f(float4 v) { g(v); }", "void f(vec4 v) { g(v); }"},
         {"void f(float4 v) { g(v); g(make_float2(v.x, v.w)); }", "void f(vec4 v) { g(v); g(v.ra); }"},
         {}},
        {"counting",
         "k.cu",
         "k.cl",
         {"void f(int* a) { g(a); }", "void f(__global int* a) { g(a); }"},
         {"void f(int* a) { g(a); atomicAdd(&a[1], 1); atomicExch(a, 2); }",
          "void f(__global int* a) { g(a); atomic_inc(&a[1]); atomic_xchg(a, 2); }"},
         {}},
        {"counting by two",
         "k.cu",
         "k.cl",
         {"void f(int* a) { g(a); }", "void f(__global int* a) { g(a); }"},
         {"void f(int* a) { g(a); atomicAdd(a, 2); }", "void f(__global int* a) { g(a); atomic_inc(a); }"},
         {"port-differs"}},
        {"HIP's constants and launches",
         "k.cu",
         "k.hip",
         {"void f(int n) { g(n); }", "void f(int n) { g(n); }"},
         {"void f(int n) { g(n); cublasX(CUBLAS_OP_N, CUDA_R_16F); k<<<n, 64>>>(n); }",
          "void f(int n) { g(n); hipblasX(HIPBLAS_OP_N, HIP_R_16F); hipLaunchKernelGGL(k, n, 64, 0, 0, n); }"},
         {}},
        {"SYCL's names",
         "k.cu",
         "k.cpp",
         {"void f(int n) { g(n); }", "void f(int n) { g(n); }"},
         {"void f(int n) { g(n); h<__nv_bfloat16>(v.x * v.y); }",
          "void f(int n) { g(n); h<sycl::ext::oneapi::bfloat16>(v.x() * v.y()); }"},
         {}},
        {"less exact on one side",
         "k.cu",
         "k.cpp",
         {"void f(float* y, float x) { y[0] = pow(x, 2.0f); }",
          "void f(float* y, float x) { y[0] = sycl::pow(x, 2.0f); }"},
         {"void f(float* y, float x) { y[0] = exp(x); }", "void f(float* y, float x) { y[0] = sycl::native::exp(x); }"},
         {"port-differs"}},
        {"as exact on one side as it was",
         "k.cu",
         "k.cpp",
         {"void f(float* y, float x) { y[0] = exp(x); }", "void f(float* y, float x) { y[0] = sycl::native::exp(x); }"},
         {"void f(float* y, float x) { y[0] = exp(2 * x); }",
          "void f(float* y, float x) { y[0] = sycl::native::exp(2 * x); }"},
         {}},
        {"one name by the same names wherever it stood",
         "k.cu",
         "k.cpp",
         {"void f(int w) { a(w, table); if (w) b(table); }", "void f(int w) { m(1, w, 0, table, q); }"},
         {"void f(int w) { a(w, table0, table1); if (w) b(table0, table1); }",
          "void f(int w) { m(1, w, 0, table0, table1, q); }"},
         {}},
        {"one name by others",
         "k.cu",
         "k.cpp",
         {"void f(int w) { a(w, table); if (w) b(table); }", "void f(int w) { m(1, w, 0, table, q); }"},
         {"void f(int w) { a(w, table0, table1); if (w) b(table0, table1); }",
          "void f(int w) { m(1, w, 0, table1, table0, q); }"},
         {"port-differs"}},
        {"one name, and something else",
         "k.cu",
         "k.cpp",
         {"void f(int w) { a(w, table); if (w) b(table); }", "void f(int w) { m(1, w, 0, table, q); }"},
         {"void f(int w) { a(w, list); if (!w) b(list); }", "void f(int w) { m(1, w, 0, list, q); }"},
         {"port-differs"}},
        {"what one side's file says",
         "k.c",
         "k.cpp",
         {"static volatile int r;\nint f(int a) { while (!r) {} return a; }", "int f(int a) { return a; }"},
         {"static int r;\nint f(int a) { while (!r) {} return a + 1; }", "int f(int a) { return a + 1; }"},
         {"port-differs"}},
        {"what both files say",
         "k.c",
         "k.cpp",
         {"static volatile int r;\nint f(int a) { while (!r) {} return a; }",
          "static volatile bool go;\nint f(int a) { return go ? a : 0; }"},
         {"static int r;\nint f(int a) { while (!r) {} g(); return a; }",
          "static bool go;\nint f(int a) { g(); return go ? a : 0; }"},
         {}},
        {"one side's edit means nothing",
         "k.cu",
         "k.cpp",
         {"float f(float a) { return a; }", "float f(float a) { return a; }"},
         {"float f(const float a) { return a; }", "float f(float a) { return a * 2.0f; }"},
         {"target-changed"}},
    };
    for (const TwoSided& row : rows)
        EXPECT_EQ(rules_of(report_on(row)), row.rules) << row.what << report_on(row).dump(1);
}

/// What the map pairs goes by either name, and by no name of another.
TEST(TwoSidedEdit, TheNamesOfPairsAreOne) {
    const std::string helpers = "int rows_cuda(int n) { return n * 2; }\nint lines_cuda(int n) { return n * 3; }\n";
    const std::string ports =
        "int rows_sycl(int n) { return n * 2; }\nint lines_sycl(int n) { return n * 3; }\nint rows_cuda(int n);\n";
    const std::string before = "void f(int n) { g(n); }\n";
    const auto rules = [&](const std::string& source, const std::string& target) {
        MemoryDisk disk;
        disk.files = {{"/r/s/k.cu", helpers + before},
                      {"/r/t/k.cpp", ports + before},
                      {"/r/portmap.toml",
                       "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n"
                       "[[pair]]\nsource = \"s/k.cu:f\"\ntarget = \"t/k.cpp:f\"\n"
                       "[[pair]]\nsource = \"s/k.cu:rows_cuda\"\ntarget = \"t/k.cpp:rows_sycl\"\n"
                       "[[pair]]\nsource = \"s/k.cu:lines_cuda\"\ntarget = \"t/k.cpp:lines_sycl\"\n"}};
        EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
        disk.files["/r/s/k.cu"] = helpers + replaced(before, "g(n);", "g(n); " + source);
        disk.files["/r/t/k.cpp"] = ports + replaced(before, "g(n);", "g(n); " + target);
        return rules_of(check(disk));
    };
    EXPECT_EQ(rules("rows_cuda(n + 1);", "rows_sycl(n + 1);"), Names{});
    EXPECT_EQ(rules("rows_cuda(n + 1);", "lines_sycl(n + 1);"), Names{"port-differs"});
    EXPECT_EQ(rules("rows_cuda(n + 1);", "rows_cuda(n + 1);"), Names{"port-differs"}) << "that is not its port";
    EXPECT_EQ(rules("other_cuda(n + 1);", "other_sycl(n + 1);"), Names{"port-differs"}) << "no pair says it";
}

/// Half of all drift is older than the gate: a side that brings in what the other has all along is no new drift.
TEST(TwoSidedEdit, ANewNameDiffersAsTheIdsOfThePairDo) {
    const auto rules = [](const std::string& source, const std::string& target) {
        const std::string before = "void f(int n) { g(n); }\n";
        return rules_of(
            report_on({source,
                       "run_cuda.cu",
                       "run-Hip.cpp",
                       {before, before},
                       {replaced(before, "g(n);", "g(n); " + source), replaced(before, "g(n);", "g(n); " + target)},
                       {}}));
    };
    EXPECT_EQ(rules("launchCudaKernel(n, 2);", "launchHipKernel(n, 2);"), Names{});
    EXPECT_EQ(rules("if (n > kLambda_CUDA) { n = 1; }", "if (n > kLambda_HIP) { n = 1; }"), Names{});
    EXPECT_EQ(rules("make_cuda_exec(n);", "make_hip_exec(n);"), Names{});
    EXPECT_EQ(rules("launchCudaKernel(n, 2);", "launchHipKernel(n, 3);"), Names{"port-differs"});
    EXPECT_EQ(rules("launchCudaKernel(n, 2);", "launchHipQueue(n, 2);"), Names{"port-differs"});
    EXPECT_EQ(rules("launchCudaKernel(n, 2);", "launchOmpKernel(n, 2);"), Names{"port-differs"});
    EXPECT_EQ(rules("launchCudaKernel(n, 2);", "launchCudaKernel(n, 2); launchHipKernel(n, 2);"),
              Names{"port-differs"});
}

TEST(TwoSidedEdit, ASideThatCatchesUpIsNoted) {
    const std::string behind = "void f(float x) {\n    float a = h(x);\n    g(a);\n}\n";
    const std::string ahead =
        replaced(behind, "    g(a)", "    if (a > 1.0f) {\n        a = cut(a, 1.0f);\n    }\n    g(a)");
    const auto levels = [](const std::string& source, const std::string& target, const std::string& source_now,
                           const std::string& target_now) {
        Names out;
        const auto report = report_on({"", "k.cu", "k.cpp", {source, target}, {source_now, target_now}, {}});
        for (const auto& finding : report["findings"])
            out.push_back(finding["rule"].get<std::string>() + " " + finding["level"].get<std::string>());
        return out;
    };
    EXPECT_EQ(levels(behind, ahead, ahead, ahead), Names{"source-changed note"});
    EXPECT_EQ(levels(ahead, behind, ahead, ahead), Names{"target-changed note"});
    EXPECT_EQ(levels(ahead, ahead, behind, ahead), Names{"source-changed error"}) << "it falls behind";
    EXPECT_EQ(levels(behind, ahead, replaced(ahead, "g(a)", "g(x)"), ahead), Names{"source-changed error"})
        << "and something else";
    EXPECT_EQ(levels(behind, ahead, replaced(ahead, "1.0f)", "2.0f)"), ahead), Names{"source-changed error"})
        << "not quite";
    EXPECT_EQ(levels(replaced(behind, "h(x)", "h(2)"), behind, behind, behind), Names{"source-changed error"})
        << "one statement for another may be so by chance";
    EXPECT_EQ(levels("static volatile int r;\n" + replaced(behind, "h(x)", "h(r)"), replaced(ahead, "h(x)", "h(r)"),
                     "static int r;\n" + replaced(ahead, "h(x)", "h(r)"), replaced(ahead, "h(x)", "h(r)")),
              Names{"source-changed error"})
        << "a declaration changed as well";
}

/// The same in the other side's own words: names of locals, a parameter more, the manner in which a project names
/// calls.
TEST(TwoSidedEdit, ASideThatCatchesUpInOtherWordsIsNoted) {
    const std::string behind =
        "void f(const float* x, float* y, int n, int i) {\n    y[i] = gpu_load(x, i);\n    gpu_push(y);\n    "
        "gpu_pop(y);\n    y[n] = 0.0f;\n}\n";
    const std::string now = replaced(
        replaced(behind, "int n,", "int n, float limit,"), "    y[i] = gpu_load(x, i);",
        "    const float v = gpu_load(x, i);\n    const float cut = min(v, limit);\n    if (cut > 0.5f * limit) {\n"
        "        y[i] = gpu_fold(cut, v, 2);\n    }");
    std::string port = replaced(now, "float limit, int i", "float limit, int i, int group");
    for (const char* call : {"load", "push", "pop", "fold"})
        port = replaced(port, std::string("gpu_") + call, std::string("cpu_") + call);
    for (const auto& [from, to] : {std::pair{" v = ", " value = "},
                                   {"(v,", "(value,"},
                                   {", v,", ", value,"},
                                   {" cut = ", " w = "},
                                   {"(cut >", "(w >"},
                                   {"(cut,", "(w,"}})
        port = replaced(port, from, to);
    const auto level = [&](const std::string& before, const std::string& after, const std::string& there) {
        const auto report = report_on({"", "k.cu", "k.cpp", {before, there}, {after, there}, {}});
        return report["findings"].empty() ? std::string() : report["findings"][0]["level"].get<std::string>();
    };
    EXPECT_EQ(level(behind, now, port), "note");
    EXPECT_EQ(level(now, behind, port), "error") << "it falls behind";
    EXPECT_EQ(level(behind, replaced(now, "0.5f", "0.25f"), port), "error") << "another number";
    EXPECT_EQ(level(behind, replaced(now, "cut > ", "cut < "), port), "error") << "another comparison";
    EXPECT_EQ(level(behind, replaced(now, "gpu_pop(y)", "gpu_pop(x)"), port), "error") << "and something else";
    EXPECT_EQ(level(behind, replaced(now, "    gpu_push(y);\n", ""), port), "error") << "and something is lost";
    EXPECT_EQ(level(behind, now, behind), "error") << "the port has nothing of it";
}

TEST(TwoSidedEdit, StructsAreComparedByTheirData) {
    const std::string kernel = "struct f { float3 o; float t; };\n";
    const std::string port =
        "class f {\npublic:\n    f(int a);\n    float length() const;\n    float3 o;\n    float t;\nprivate:\n    "
        "friend struct B;\n"
        "    static int count;\n};\n";
    const std::string larger =
        "class f : public Base {\npublic:\n    f(int a);\n    virtual float length() const;\n    float3 o;\n    float "
        "t;\n"
        "private:\n    std::vector<float> more;\n    MACRO(f)\n};\n";
    const std::vector<TwoSided> rows = {
        {"a member function",
         "k.cl",
         "k.cpp",
         {kernel, port},
         {kernel, replaced(port, "float length", "float area() const;\n    float length")},
         {}},
        {"an access word",
         "k.cl",
         "k.cpp",
         {kernel, port},
         {kernel, replaced(port, "public:", "public:\n    int g();\nprotected:")},
         {}},
        {"a field of one",
         "k.cl",
         "k.cpp",
         {kernel, port},
         {replaced(kernel, "float t;", "float t, u;"), port},
         {"layout-differs"}},
        {"a field of the other",
         "k.cl",
         "k.cpp",
         {kernel, port},
         {kernel, replaced(port, "float t;", "double t;")},
         {"layout-differs"}},
        {"a field of both",
         "k.cl",
         "k.cpp",
         {kernel, port},
         {replaced(kernel, "float t;", "float t, u;"), replaced(port, "float t;", "float t;\n    float u;")},
         {}},
        {"fields that were others before",
         "k.cl",
         "k.cpp",
         {kernel, larger},
         {kernel, replaced(larger, "f(int a);", "f(int a, int b);")},
         {}},
        {"a field of both where others differ",
         "k.cl",
         "k.cpp",
         {kernel, larger},
         {replaced(kernel, "float t;", "float t; float u;"), replaced(larger, "float t;", "float t;\n    float u;")},
         {}},
        {"a field of one where others differ",
         "k.cl",
         "k.cpp",
         {kernel, larger},
         {replaced(kernel, "float t;", "float t; float u;"), larger},
         {"source-changed"}},
        {"a field of the port where others differ",
         "k.cl",
         "k.cpp",
         {kernel, larger},
         {kernel, replaced(larger, "> more", "> most")},
         {"target-changed"}},
        {"a packing",
         "k.cl",
         "k.cpp",
         {"#pragma pack(1)\n" + kernel + "#pragma pack()\n", port},
         {"#pragma pack(2)\n" + kernel + "#pragma pack()\n", port},
         {"source-changed"}},
        {"a packing that ends",
         "k.cl",
         "k.cpp",
         {"#pragma pack(push, 1)\n#pragma pack(pop)\n" + kernel, port},
         {"#pragma pack(push, 2)\n#pragma pack(pop)\n" + kernel, port},
         {}},
        {"an attribute behind it",
         "k.cl",
         "k.cpp",
         {replaced(kernel, "};", "} __attribute__((packed));"), port},
         {kernel, port},
         {"source-changed"}},
        {"the type of a field",
         "k.cl",
         "k.cpp",
         {"struct f { typedef float T; T o; };\n", port},
         {"struct f { typedef double T; T o; };\n", port},
         {"source-changed"}},
        {"a type that no field has",
         "k.cl",
         "k.cpp",
         {kernel, replaced(port, "float3 o", "typedef float T; float3 o")},
         {kernel, replaced(port, "float3 o", "typedef double T; float3 o")},
         {}},
        {"volatile",
         "k.cl",
         "k.cpp",
         {kernel, port},
         {replaced(kernel, "float t", "volatile float t"), port},
         {"source-changed"}},
    };
    for (const TwoSided& row : rows)
        EXPECT_EQ(rules_of(report_on(row)), row.rules) << row.what << report_on(row).dump(1);
}

TEST(TwoSidedEdit, FieldsGetTheTypesThatTheirSiblingsHave) {
    const auto says = [](const std::string& source, const std::string& target) {
        const auto text = [](const std::string& type, const std::string& more) {
            return "struct S { float3 at; " + type + " shadows; " + type + " fog; " + more + " float far; };\n";
        };
        MemoryDisk disk;
        disk.files = {{"/r/s/k.h", text("cl_int", "")},
                      {"/r/t/k.h", text("bool", "")},
                      {"/r/portmap.toml",
                       "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n"
                       "[[pair]]\nsource = \"s/k.h:S\"\ntarget = \"t/k.h:S\"\n"}};
        EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
        disk.files["/r/s/k.h"] = text("cl_int", source);
        disk.files["/r/t/k.h"] = text("bool", target);
        return rules_of(check(disk));
    };
    EXPECT_EQ(says("cl_int glow;", "bool glow;"), Names{});
    EXPECT_NE(says("cl_int glow;", "float glow;"), Names{});
    EXPECT_NE(says("cl_int glow;", "bool haze;"), Names{});
    EXPECT_NE(says("cl_int glow; cl_int haze;", "bool haze; bool glow;"), Names{});
    EXPECT_NE(says("cl_int glow; cl_int haze;", "bool glow;"), Names{});
}

TEST(TwoSidedEdit, LongValuesAreQuotedWhereTheyDiffer) {
    std::string list = "const int f[] = {";
    for (int i = 0; i < 40; ++i) list += std::to_string(100 + i) + ", ";
    const std::string before = list + "7};\n", now = list + "8};\n";
    const auto report = report_on({"", "k.cu", "k.cpp", {before, before}, {now, before}, {}});
    ASSERT_EQ(rules_of(report), Names{"constant-differs"});
    const std::string message = report["findings"][0]["message"];
    EXPECT_NE(message.find("139, 8}'"), std::string::npos) << message;
    EXPECT_NE(message.find("139, 7}'"), std::string::npos) << message;
}

TEST(TwoSidedEdit, HazardsAreThoseOfThePairsLanguages) {
    const auto hazards = [](const std::string& source_file, const std::string& target_file, const std::string& call) {
        const std::string before = "float f(float a) { return a; }", now = "float f(float a) { return " + call + "; }";
        const auto report = report_on({"", source_file, target_file, {before, before}, {now, before}, {}});
        Names out;
        for (const auto& finding : report["findings"])
            if (finding["rule"] == "dialect-hazard") out.push_back(finding["message"]);
        return out;
    };
    EXPECT_EQ(hazards("k.cl", "k.cpp", "pow(a, a)"), Names{});
    EXPECT_EQ(hazards("k.glsl", "k.comp", "pow(a, a)"), Names{});
    EXPECT_EQ(hazards("k.cu", "k.glsl", "pow(a, a)"),
              Names{"pow of a zero or negative base is undefined in GLSL and is defined in CUDA"});
    EXPECT_EQ(hazards("k.cu", "k.hip", "fmod(a, a) + int(a) + min(a, a)"), Names{});
    EXPECT_EQ(hazards("k.hlsl", "k.glsl", "fmod(a, a)").size(), 1u);
    EXPECT_EQ(hazards("k.cl", "k.cpp", "mad(a, a, a)"),
              Names{"mad may round once or twice in OpenCL and is spelled fma and rounds once, or a * b + c and rounds "
                    "twice in C++"});
}

TEST(TwoSidedEdit, WhatIsLessExactOnOneSideIsSaid) {
    const std::string before = "float f(float a) { return a; }";
    const auto said = [&](const std::string& source, const std::string& target) {
        const auto report = report_on(
            {"",
             "k.cu",
             "k.cl",
             {before, before},
             {replaced(before, "return a", "return " + source), replaced(before, "return a", "return " + target)},
             {}});
        EXPECT_EQ(rules_of(report), Names{}) << report.dump(1);
        Names out;
        for (const auto& finding : report["findings"])
            if (finding["rule"] == "dialect-hazard") out.push_back(finding["message"]);
        return out;
    };
    EXPECT_EQ(said("expf(a)", "native_exp(a)"),
              Names{"expf of the source is native_exp in the port, which is less exact"});
    EXPECT_EQ(said("__sinf(a)", "sin(a)"), Names{"__sinf of the source is sin in the port, which is more exact"});
    EXPECT_EQ(said("__expf(a)", "native_exp(a)"), Names{});
    EXPECT_EQ(said("expf(a)", "exp(a)"), Names{});
}

TEST(TwoSidedEdit, TheHeadlineIsWhatIsLeftAfterAlignment) {
    const std::string before = "float f(float a, float b) { g(a); h(b); return a; }";
    const auto first = [](const nlohmann::json& report) { return report["findings"][0]["message"].get<std::string>(); };
    const auto moved = report_on(
        {"", "k.cu", "k.cpp", {before, before}, {"float f(float a, float b) { h(b); g(a); return b; }", before}, {}});
    EXPECT_NE(first(moved).find("- return a"), std::string::npos) << first(moved);
    const auto differs = report_on({"",
                                    "k.cu",
                                    "k.cpp",
                                    {before, before},
                                    {"float f(float a, float b) { k(b); g(a); h(b); return a * 2.0f + b; }",
                                     "float f(float a, float b) { k(b); g(a); h(b); return a * 2.0f - b; }"},
                                    {}});
    ASSERT_EQ(rules_of(differs), Names{"port-differs"});
    EXPECT_NE(first(differs).find("the source has `return a * 2f + b` where the port has `return a * 2f - b`"),
              std::string::npos)
        << first(differs);
    // What was ported alike, in words of each side, is no difference that is left; a local's new name is none.
    const std::string source = "float f(float4 p, float s) { float d = length(p.xyz) - 1.0f; return d * s + 0.1f; }",
                      port =
                          "float f(P p, float s) { float dist = p.xyz().length() - 1.0f; return add(dist, s, 0.1f); }";
    const auto left = report_on({"",
                                 "k.cu",
                                 "k.cpp",
                                 {source, port},
                                 {"float f(float4 p, float s) { float d = length(p.xyz) - 1.5f; return d * s + 0.2f; }",
                                  replaced(port, "1.0f", "1.5f")},
                                 {}});
    ASSERT_EQ(rules_of(left), Names{"port-differs"});
    EXPECT_NE(first(left).find("the source gained `return d * s + 0.2f`; the port did not"), std::string::npos)
        << first(left);
    EXPECT_EQ(first(left).find("1.5f"), std::string::npos) << first(left);
    const auto renamed =
        report_on({"",
                   "k.cu",
                   "k.cpp",
                   {source, port},
                   {"float f(float4 p, float s) { float e = length(p.xyz) - 1.0f; return e * s + 0.2f; }", port},
                   {}});
    ASSERT_EQ(rules_of(renamed), Names{"source-changed"});
    EXPECT_NE(first(renamed).find("- return d * s + 0.1f"), std::string::npos) << first(renamed);
}

TEST(TwoSidedEdit, APortThatMovedAndWasEditedIsNotGone) {
    const std::string body =
        "(float a, float b) {\n    float c = a * b + a;\n    float d = c * c - b;\n    return c / d + a * d;\n}\n";
    MemoryDisk disk;
    disk.files = {{"/r/s/k.cu", "float f" + body},
                  {"/r/t/k.cpp", "float f" + body + "float h(int n) { return n * 2; }\n"}};
    ASSERT_EQ(run(disk, {"-C", "/r", "init", "--source", "s/*", "--target", "t/*"}).exit_code, 0);
    disk.files["/r/t/k.cpp"] = "float h(int n) { return n * 2; }\n";
    disk.files["/r/t/other.cpp"] = "float f" + replaced(body, "a * d", "a - d");
    const auto moved = check(disk);
    EXPECT_EQ(rules_of(moved), Names{"target-changed"}) << moved.dump(1);
    EXPECT_NE(moved.dump().find("is now t/other.cpp:f"), std::string::npos);
    disk.files["/r/s/k.cu"] = "float g(int n) { return n; }\n";
    disk.files.erase("/r/t/other.cpp");
    const auto gone = check(disk);
    EXPECT_EQ(rules_of(gone), Names{}) << "both sides took it away: the same edit\n" << gone.dump(1);
    size_t orphaned = 0;
    for (const auto& finding : gone["findings"]) {
        if (finding["rule"] != "orphaned") continue;
        ++orphaned;
        EXPECT_EQ(finding["remedy"].get<std::string>().find("Remove the port"), std::string::npos);
    }
    EXPECT_EQ(orphaned, 1u) << "the map still names it";
}

TEST(TwoSidedEdit, APortThatMovedWithItsFileIsFoundByItsWords) {
    const std::string body =
        "(float a, float b) {\n    float c = a * b + a;\n    float d = c * c - b;\n    return c / d + a * d;\n}\n";
    const std::string other =
        "(int n, int m) {\n    int k = n % m;\n    while (k > 2) k -= m / 2;\n    return k << 1 | n & m;\n}\n";
    const std::string source = "float f" + body + "int h" + other, map = "version = 1\n[sides]\nsource = [\"s/*\"]\n";
    const auto after = [&](const std::string& reference, const std::map<std::string, std::string>& ports) {
        MemoryDisk disk;
        disk.files = {{"/r/s/k.cu", source},
                      {"/r/t/k.cpp", source},
                      {"/r/portmap.toml", map + "target = [\"t/*\"]\nreference = \"" + reference +
                                              "\"\n[[pair]]\nsource = \"s/k.cu:f\"\ntarget = \"t/k.cpp:f\"\n"
                                              "[[pair]]\nsource = \"s/k.cu:h\"\ntarget = \"t/k.cpp:h\"\n"}};
        EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
        disk.files.erase("/r/t/k.cpp");
        for (const auto& [file, text] : ports) disk.files["/r/t/" + file] = text;
        return check(disk);
    };
    const std::string edited = "float weigh" + replaced(body, "a * d", "a - d"), sibling = "int h" + other;
    const auto moved = after("source", {{"new.cpp", edited + sibling}});
    EXPECT_EQ(rules_of(moved), Names{"target-changed"}) << moved.dump(1);
    EXPECT_NE(moved.dump().find("t/k.cpp:f is now t/new.cpp:weigh"), std::string::npos);
    // Not where none of its siblings went, nor where two are as much alike, nor where the words are others.
    EXPECT_EQ(rules_of(after("source", {{"new.cpp", sibling}, {"far.cpp", edited}})), Names{"dead-link"});
    EXPECT_EQ(
        rules_of(after("source", {{"new.cpp", edited + "float sum" + replaced(body, "a * d", "b * d") + sibling}})),
        Names{"dead-link"});
    EXPECT_EQ(rules_of(after("source", {{"new.cpp", "float weigh(float a) { return a; }\n" + sibling}})),
              Names{"dead-link"});
    // The side that only follows is what may go.
    const auto gone = after("target", {{"k.cpp", sibling}});
    ASSERT_EQ(rules_of(gone), Names{"orphaned"});
    EXPECT_NE(gone.dump().find("Remove s/k.cu:f and its [[pair]]"), std::string::npos) << gone.dump(1);
}

TEST(TwoSidedEdit, AFunctionThatBecameAMethodIsTheSameFunction) {
    const std::string text =
        "void f(const float* a, int n) {\n    float c = a[0] * n + a[1];\n    put(c * c - a[2], n);\n}\n";
    const auto after = [&](const std::string& now) {
        return report_on({"", "k.cu", "k.cpp", {text, text}, {text, now}, {}});
    };
    const auto method = after(replaced(text, "void f", "void Splatter::f"));
    EXPECT_EQ(rules_of(method), Names{});
    EXPECT_NE(method.dump().find("is now t/k.cpp:Splatter::f"), std::string::npos) << method.dump(1);
    EXPECT_EQ(rules_of(after(replaced(replaced(text, "void f", "void Splatter::f"), "int n", "long n"))),
              Names{"target-changed"});
}

TEST(TwoSidedEdit, WhoCallsARenamedUnitWasNotEdited) {
    const std::string body = "(float a, float b) {\n    float c = a * b + a;\n    return c / b + a * c;\n}\n";
    const std::string caller = "float use(float a) { return weigh(a, 2.0f) + a; }\n";
    MemoryDisk disk;
    disk.files = {{"/r/s/k.cu", "float weigh" + body + caller}, {"/r/t/k.cpp", "float weigh" + body + caller}};
    ASSERT_EQ(run(disk, {"-C", "/r", "init", "--source", "s/*", "--target", "t/*"}).exit_code, 0);
    disk.files["/r/s/k.cu"] = "float balance" + body + replaced(caller, "weigh", "balance");
    EXPECT_EQ(rules_of(check(disk)), Names{}) << "the rename itself is a note";
    // An edit beside it is told, and a name that another unit has now means something else.
    disk.files["/r/s/k.cu"] = "float balance" + body + replaced(replaced(caller, "weigh", "balance"), "+ a", "- a");
    EXPECT_EQ(rules_of(check(disk)), Names{"source-changed"});
    disk.files["/r/s/k.cu"] =
        "float balance" + body + "float weigh(float a, float b) { return a; }\n" + replaced(caller, "weigh", "balance");
    EXPECT_NE(rules_of(check(disk)), Names{});
}

TEST(TwoSidedEdit, ParenthesesAroundOneValueChangeNothing) {
    const auto says = [](const std::string& source, const std::string& target) {
        MemoryDisk disk;
        const std::string head = "float f(Ray ray, float a) {\n    float b = a;\n    b = ";
        disk.files = {{"/r/s/k.cu", head + "ray.t * 2.0f;\n    return b;\n}\n"},
                      {"/r/t/k.cpp", head + "(ray.t) * 2.0f;\n    return b;\n}\n"}};
        EXPECT_EQ(run(disk, {"-C", "/r", "init", "--source", "s/*", "--target", "t/*"}).exit_code, 0);
        disk.files["/r/s/k.cu"] = head + source + ";\n    return b;\n}\n";
        disk.files["/r/t/k.cpp"] = head + target + ";\n    return b;\n}\n";
        return rules_of(check(disk));
    };
    EXPECT_EQ(says("ray.t * 3.0f", "(ray.t) * 3.0f"), Names{});
    EXPECT_EQ(says("a + 3.0f / a", "a + (3.0f) / (a)"), Names{});
    EXPECT_EQ(says("a * (ray.t + 3.0f)", "a * ray.t + 3.0f"), Names{"port-differs"});
    // What is taken together anyway.
    EXPECT_EQ(says("a * ray.t / g(a) - 3.0f", "(a * ray.t / g(a)) - 3.0f"), Names{});
    EXPECT_EQ(says("3.0f - a * (ray.t + a)", "3.0f - (a * (ray.t + a))"), Names{});
    EXPECT_EQ(says("ray.t + a - 3.0f", "(ray.t + a) - 3.0f"), Names{});
    EXPECT_EQ(says("ray.t - (a + 3.0f)", "ray.t - a + 3.0f"), Names{"port-differs"});
    EXPECT_EQ(says("ray.t / (a * 3.0f)", "ray.t / a * 3.0f"), Names{"port-differs"});
    EXPECT_EQ(says("ray.t * (a / 3.0f)", "ray.t * a / 3.0f"), Names{"port-differs"});
    EXPECT_EQ(says("-(a + ray.t) + 3.0f", "-a + ray.t + 3.0f"), Names{"port-differs"});
    EXPECT_EQ(says("(a + ray.t) * 3.0f", "a + ray.t * 3.0f"), Names{"port-differs"});
    EXPECT_EQ(says("a * (Real)-ray.t", "a * Real - ray.t"), Names{"port-differs"}) << "a cast is none";
    EXPECT_EQ(says("a * g(ray.t)", "a * g * ray.t"), Names{"port-differs"});
}

TEST(TwoSidedEdit, OfStatementsThatAreAsLikeEachOtherTheSameOneInTheirOrder) {
    const std::string source =
        "__kernel void f(__global float* f, __global float* g, float k) {\n"
        "    int i = get_global_id(0);\n"
        "    float q = f[i] * k - 0.5f;\n"
        "    float h = g[i] * k - 0.5f;\n"
        "    f[i] = q * 2.0f;\n"
        "    g[i] = h * 2.0f;\n"
        "}\n";
    const std::string target =
        "void f(struct S *s, int n, float k) {\n"
        "    for (int i = 0; i < n; i++) {\n"
        "        float first = s[i].left * k - 0.5f;\n"
        "        float second = s[i].right * k - 0.5f;\n"
        "        s[i].left = first * 2.0f;\n"
        "        s[i].right = second * 2.0f;\n"
        "    }\n"
        "}\n";
    const auto says = [&](const std::pair<std::string, std::string>& here,
                          const std::pair<std::string, std::string>& there) {
        return rules_of(
            report_on({"",
                       "k.cl",
                       "k.c",
                       {source, target},
                       {replaced(source, here.first, here.second), replaced(target, there.first, there.second)},
                       {}}));
    };
    EXPECT_EQ(says({"q * 2.0f", "q * 4.0f"}, {"first * 2.0f", "first * 4.0f"}), Names{});
    EXPECT_EQ(says({"q * 2.0f", "q * 4.0f"}, {"second * 2.0f", "second * 4.0f"}), Names{"port-differs"});
    EXPECT_EQ(says({"h * 2.0f", "h * 4.0f"}, {"second * 2.0f", "second * 4.0f"}), Names{});
    EXPECT_EQ(says({"h * 2.0f", "h * 4.0f"}, {"first * 2.0f", "first * 4.0f"}), Names{"port-differs"});
    EXPECT_EQ(says({"g[i] * k - ", "g[i] * k + "}, {"right * k - ", "right * k + "}), Names{});
    EXPECT_EQ(says({"g[i] * k - ", "g[i] * k + "}, {"left * k - ", "left * k + "}), Names{"port-differs"});
}

}  // namespace
}  // namespace porttool::testing::two_sided_edit_test
