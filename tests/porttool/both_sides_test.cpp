// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Both sides changed: when that is the same edit. The expectations are what the two programs compute.
#include <gtest/gtest.h>

#include "porttool/language/dialect.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::both_sides_test {
namespace {

using Edit = std::pair<std::string, std::string>;

/// The findings of check after both sides of a pair changed, without notes: "" if the pair is in step.
std::string found(const std::string& source, const std::string& target, const std::string& source_now,
                  const std::string& target_now, const std::string& suffix = ".comp") {
    MemoryDisk disk;
    const std::string port = "/r/port/k" + suffix;
    disk.files = {{"/r/src/k.cu", source}, {port, target}};
    run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"});
    EXPECT_EQ(check(disk)["summary"]["in_step"], 1);
    disk.files["/r/src/k.cu"] = source_now;
    disk.files[port] = target_now;
    const auto report = check(disk);
    std::string out;
    for (const auto& finding : report["findings"])
        if (finding["level"] != "note")
            out += finding["rule"].get<std::string>() + ": " + finding["details"].dump() + "\n";
    return out;
}

/// A body as a kernel in CUDA and, with its literals and types respelled, as a function in GLSL.
std::string as_cuda(const std::string& body) {
    return "__device__ float f(float a, float x, int m, int n) {\n" + body + "\n}\n";
}
std::string as_glsl(std::string body) {
    for (size_t at = 0; (at = body.find("5f", at)) != std::string::npos;) body.erase(at + 1, 1);
    return "float f(float a, float x, int m, int n) {\n" + body + "\n}\n";
}

/// What check finds when both sides start with `body` and are edited, each in its way.
std::string found_in(const std::string& body, const std::string& source_now, const std::string& target_now) {
    return found(as_cuda(body), as_glsl(body), as_cuda(source_now), as_glsl(target_now));
}

struct Place {
    std::string body, one, other;
    std::string says;
};

TEST(BothSides, TheSameStatementInAnotherPlaceIsAnotherEdit) {
    const std::string loop = "float s = x; for (int i = 0; i < n; ++i) { a += step(i); } return a;";
    const std::string branch = "if (m > 0) { a += x; note(); } a -= x; return a;";
    const std::string repeated = "x += a; f(); x += a; return x;";
    const std::string both = "if (m > 0) { g(); f(); } else { h(); f(); } return a;";
    const std::string cases =
        "switch (m) { case 0: a = x; break; case 1: a = 2.5f; break; default: a = 3.5f; } return a;";
    const std::vector<Place> rows = {
        {loop, replaced(loop, "step(i); }", "step(i); a *= 0.5f; }"),
         replaced(loop, "step(i); }", "step(i); } a *= 0.5f;"),
         "in `for (int i = 0; i < n; + + i)` in the source, in the function's body in the port"},
        {branch, replaced(branch, "note(); }", "note(); a = 0; }"), replaced(branch, "note(); }", "note(); } a = 0;"),
         "in `if (m > 0)` in the source, in the function's body in the port"},
        {branch, replaced(branch, "note(); }", "} note();"), replaced(branch, "} a -= x;", "a -= x; }"),
         "`if (m > 0)`"},
        {repeated, "f(); x += a; return x;", "x += a; f(); return x;", "lost `x + = a`"},
        {both, replaced(both, "g(); f();", "g();"), replaced(both, "h(); f();", "h();"),
         "in `if (m > 0)` in the source, in `else` in the port"},
        {cases, replaced(cases, "a = x; break;", "a = x;"), replaced(cases, "a = 2.5f; break;", "a = 2.5f;"),
         "lost `break`"}};
    for (const Place& row : rows) {
        const std::string differs = found_in(row.body, row.one, row.other);
        EXPECT_TRUE(differs.starts_with("port-differs")) << row.one << "\n" << row.other;
        std::string told = differs, wanted = row.says;
        for (std::string* text : {&told, &wanted}) std::erase(*text, ' ');
        EXPECT_NE(told.find(wanted), std::string::npos) << differs;
        EXPECT_EQ(found_in(row.body, row.one, row.one), "") << row.one;
        EXPECT_EQ(found_in(row.body, row.other, row.other), "") << row.other;
    }
}

TEST(BothSides, TheSameWordsInAnotherPlaceOfAStatementAreAnotherEdit) {
    struct Row {
        const char *body, *source, *target;
    };
    const std::vector<Row> rows = {
        {"if (m > 0 && n > 0) a *= x; return a;", "if (m > 1 && n > 0) a *= x; return a;",
         "if (m > 0 && n > 1) a *= x; return a;"},
        {"return load(m + 1) - load(m - 1);", "return load(m + 2) - load(m - 1);", "return load(m + 1) - load(m - 2);"},
        {"return m / 2 + n / 2;", "return m / 4 + n / 2;", "return m / 2 + n / 4;"},
        {"return a * x + a * m;", "return -a * x + a * m;", "return a * x + -a * m;"},
        {"return clamp(m, 0, 1) + clamp(n, 0, 1);", "return clamp(m, 0, 2) + clamp(n, 0, 1);",
         "return clamp(m, 0, 1) + clamp(n, 0, 2);"}};
    for (const Row& row : rows) {
        EXPECT_NE(found_in(row.body, row.source, row.target).find("port-differs"), std::string::npos) << row.source;
        EXPECT_EQ(found_in(row.body, row.source, row.source), "") << row.source;
        EXPECT_EQ(found_in(row.body, row.target, row.target), "") << row.target;
    }
}

TEST(BothSides, WhatTheVocabularyDropsAndStillChangesValuesIsAnEditOfItsOwn) {
    const std::string body = "a += x; return a;";
    const auto in_cpp = [&](const std::string& source, const std::string& target) {
        const auto text = [](const std::string& head, const std::string& inner) {
            return head + "float f(float a, float x, int m, int n) {\n" + inner + "\n}\n";
        };
        return found(text("__device__ ", body), text("", body), text("__device__ ", source + body),
                     text("", target + body), ".cpp");
    };
    EXPECT_EQ(in_cpp("volatile float q = x; ", "volatile float q = x; "), "");
    EXPECT_NE(in_cpp("volatile float q = x; ", "float q = x; ").find("`volatile`"), std::string::npos);
    EXPECT_NE(in_cpp("float q = x; ", "volatile float q = x; ").find("`volatile`"), std::string::npos);
    EXPECT_EQ(in_cpp("long k = 1ull << n; ", "long k = 1ULL << n; "), "");
    EXPECT_NE(in_cpp("long k = 1ull << n; ", "long k = 1 << n; ").find("64 bits"), std::string::npos);
}

TEST(BothSides, ABarrierIsOneInCudaAndInOpenCl) {
    const std::string source = "__global__ void f(float* a) {\n    a[0] = 1.0f;\n    a[1] = a[0];\n}\n";
    const std::string target = "__kernel void f(__global float* a) {\n    a[0] = 1.0f;\n    a[1] = a[0];\n}\n";
    EXPECT_EQ(found(source, target, replaced(source, "    a[1]", "    __syncthreads();\n    a[1]"),
                    replaced(target, "    a[1]", "    barrier(CLK_LOCAL_MEM_FENCE);\n    a[1]"), ".cl"),
              "");
    EXPECT_NE(found(source, target, replaced(source, "    a[1]", "    __syncthreads();\n    a[1]"),
                    replaced(target, "a[1] = a[0]", "a[1] = a[0] + 0.0f"), ".cl"),
              "");
}

TEST(BothSides, TheSamePlaceInABodyThatThePortSpellsOtherwiseIsTheSameEdit) {
    const std::string source = "float s = x; for (int i = 0; i < n; ++i) { a += step(i); a += s; } return a;";
    const std::string target = "float s = x; for (uint i = 0u; i < count; ++i) { a += step(i); a += s; } return a;";
    const Edit inside = {"a += s;", "a += s; a *= 0.5f;"}, outside = {"return a", "a *= 0.5f; return a"};
    const auto edited = [&](const Edit& here, const Edit& there) {
        return found(as_cuda(source), as_glsl(target), as_cuda(replaced(source, here.first, here.second)),
                     as_glsl(replaced(target, there.first, there.second)));
    };
    EXPECT_EQ(edited(inside, inside), "");
    EXPECT_EQ(edited(outside, outside), "");
    EXPECT_NE(edited(inside, outside), "");
    EXPECT_NE(edited(outside, inside), "");
}

TEST(BothSides, AMovedBraceOnOneSideNamesTheStatementThatMoved) {
    const std::string body = "if (m > 0) { a += x; note(); } a -= x; return a;";
    const std::string moved = replaced(body, "note(); }", "} note();");
    const std::string told = found(as_cuda(body), as_glsl(body), as_cuda(moved), as_glsl(body));
    EXPECT_EQ(told.find("rearranged"), std::string::npos) << told;
    EXPECT_NE(told.find("note()"), std::string::npos) << told;
}

/// What each side's new statement is, and whether they mean the same.
struct Words {
    std::string source, target;
    bool same;
};

void expect_words(const std::vector<Words>& rows, const std::string& suffix) {
    const std::string head =
                          "float f(float a, float in, float out, int n, uint u, uint U, int n_1, int n1, thing "
                          "buffer) {\n    float y = a;\n",
                      tail = "    return y * a;\n}\n";
    for (const Words& row : rows) {
        const std::string told = found("__device__ " + head + tail, head + tail,
                                       "__device__ " + head + row.source + tail, head + row.target + tail, suffix);
        EXPECT_EQ(told.empty(), row.same) << row.source << " | " << row.target << "\n" << told;
    }
}

TEST(BothSides, WordsOfOtherMeaningAreOtherEditsInGlsl) {
    expect_words({{"y = n / 2;", "y = n / 2.0f;", false},
                  {"y = a * 0.5f;", "y = a * 0.5;", true},
                  {"y = a * 2.0f;", "y = a * 2.;", true},
                  {"y = a * 1e-5f;", "y = a * 1e-5;", true},
                  {"y = rint(a);", "y = round(a);", false},
                  {"y = rintf(a);", "y = rint(a);", true},
                  {"y = fmod(a, y);", "y = mod(a, y);", false},
                  {"y = __clz(n);", "y = findMSB(n);", false},
                  {"y = __ffs(n);", "y = findLSB(n);", false},
                  {"y = INFINITY;", "y = FLT_MAX;", false},
                  {"y = fabsf(a);", "y = abs(a);", true},
                  {"y = lerp(a, y, a);", "y = mix(a, y, a);", true},
                  {"y = n_1;", "y = n1;", false},
                  {"y = u;", "y = U;", false},
                  {"y = u;", "y = u;", true},
                  {"y = shadow_ray(a);", "y = shadowRay(a);", true},
                  {"y = in;", "y = out;", false},
                  {"y = g(in, buffer);", "y = g(buffer, in);", false},
                  {"y = g(in, buffer);", "y = g(in, buffer);", true},
                  {"static int k = 0;", "int k = 0;", false},
                  {"static const int k = 0;", "const int k = 0;", true},
                  {"__shared__ float k[2];", "float k[2];", false},
                  {"__shared__ float k[2];", "shared float k[2];", true},
                  {"const float* p = q;", "float* p = q;", true},
                  {"unsigned int k = 3u;", "uint k = 3u;", true},
                  {"unsigned int k = 3u;", "int k = 3;", false},
                  {"y = (float)n;", "y = float(n);", true},
                  {"y = (float)n / a;", "y = float(n) / a;", true},
                  {"y = (float)n / a;", "y = float(n / a);", false},
                  {"y = (float)(n + 1) * a;", "y = float(n + 1) * a;", true},
                  {"y = (unsigned int)-n;", "y = uint(-n);", true},
                  {"y = static_cast<float>(n);", "y = float(n);", true},
                  {"y = (a) * n;", "y = a(n);", false}},
                 ".comp");
}

TEST(BothSides, WordsOfOtherMeaningAreOtherEditsInCpp) {
    expect_words({{"y = a * 1e-5f;", "y = a * 1e-5;", false},
                  {"y = a * 1e-5f;", "y = a * 0.00001f;", true},
                  {"y = abs(n);", "y = fabs(n);", false},
                  {"y = fabsf(a);", "y = fabs(a);", true},
                  {"y = N1::foo(a);", "y = N2::foo(a);", false},
                  {"y = N1::foo(a);", "y = N1::foo(a);", true},
                  {"y = N1::foo(a);", "y = foo(a);", true},
                  {"y = std::sqrt(a);", "y = sqrtf(a);", true}},
                 ".cpp");
}

TEST(BothSides, AScopeThatThePortCallsOtherwiseThroughoutIsTheSame) {
    const std::string source = "__device__ float f(float a) {\n    float y = cuda::foo(a);\n    return y;\n}\n";
    const std::string target = "float f(float a) {\n    float y = cpu::foo(a);\n    return y;\n}\n";
    const Edit more = {"return y", "y += S::bar(y); return y"};
    const auto with = [&](const std::string& text, const std::string& scope) {
        return replaced(replaced(text, more.first, more.second), "S::", scope + "::");
    };
    EXPECT_EQ(found(source, target, with(source, "cuda"), with(target, "cpu"), ".cpp"), "");
    EXPECT_NE(found(source, target, with(source, "cuda"), with(target, "other"), ".cpp"), "");
}

/// A CUDA host function or kernel and its port to SYCL, edited on both sides.
std::string found_in_sycl(const Edit& bodies, const Edit& bodies_now) {
    const auto cuda = [](const std::string& body) {
        return "void f(float* p, float* h, int n) {\n    int g = n / 4;\n" + body + "}\n";
    };
    const auto sycl = [](const std::string& body) {
        return "void f(sycl::queue& q, float* p, float* h, int n) {\n    int g = n / 4;\n" + body + "}\n";
    };
    return found(cuda(bodies.first), sycl(bodies.second), cuda(bodies_now.first), sycl(bodies_now.second), ".cpp");
}

TEST(BothSides, WhatARuntimeWantsHandedOnHoldsNoData) {
    const Edit none = {"run(p, n);\n", "run(q, p, n);\n"};
    const auto more = [&](const std::string& source, const std::string& target) {
        return found_in_sycl(none, {none.first + source, none.second + target});
    };
    EXPECT_EQ(more("run(h, n);\n", "run(q, h, n);\n"), "");
    EXPECT_EQ(more("go(n);\n", "go(n, q);\n"), "");
    EXPECT_NE(more("run(h, n);\n", "run(q, p, n);\n"), "");
    EXPECT_NE(more("run(h, n);\n", "run(q, h, n, n);\n"), "");
    const std::string kernel = "__global__ void k(float* r, int size, int n) {\n    r[threadIdx.x] = size;\n}\n";
    const std::string port =
        "void k(float* r, int size, int n, sycl::nd_item<1>& item) {\n    r[item.get_local_id(0)] = size;\n}\n";
    const std::string now = replaced(kernel, ", int n", "");
    EXPECT_EQ(found(kernel, port, now, replaced(port, ", int n", ""), ".cpp"), "");
    EXPECT_NE(found(kernel, port, now, replaced(port, "int size, ", ""), ".cpp"), "");
    EXPECT_NE(found(kernel, port, kernel, replaced(port, ", sycl::nd_item<1>& item", ""), ".cpp"), "")
        << "an edit of one side alone is one";
}

TEST(BothSides, MemoryOfADeviceIsFilledAndCopiedInTwoManners) {
    struct Row {
        const char *source, *target;
        bool same;
    };
    for (const Row& row : std::vector<Row>{
             {"cudaMemset(p, 0, n);", "q.memset(p, 0, n).wait();", true},
             {"cudaMemset(p, 0, n);", "q.memset(p, 1, n).wait();", false},
             {"cudaMemset(p, 0, n);", "q.memset(h, 0, n).wait();", false},
             {"cudaMemset(p, 0, n);", "q.memset(p, 0, n);", false},  // nothing says that the queue keeps the order
             {"cudaMemcpy(p, h, n, cudaMemcpyHostToDevice);", "q.memcpy(p, h, n).wait();", true},
             {"cudaMemcpy(p, h, n, cudaMemcpyHostToDevice);", "q.memcpy(p, h, n);", false},
             {"cudaMemcpy(p, h, n, cudaMemcpyHostToDevice);", "q.memcpy(h, p, n).wait();", false},
             {"cudaMemcpyAsync(p, h, n, cudaMemcpyHostToDevice, 0);", "q.memcpy(p, h, n);", true},
             {"cudaDeviceSynchronize();", "q.wait();", true},
             {"cudaDeviceSynchronize();", "", false}})
        EXPECT_EQ(found_in_sycl({"", ""}, {row.source, row.target}) == "", row.same) << row.source << row.target;
    const std::string copy = "cudaMemcpy(p, h, n, cudaMemcpyHostToDevice);\n", there = "q.memcpy(p, h, n).wait();\n";
    EXPECT_EQ(found_in_sycl({copy, there}, {copy + "g += 1;\n", there + "g += 1;\n"}), "");
    EXPECT_NE(found_in_sycl({copy, there},
                            {replaced(copy, "HostToDevice", "DeviceToHost") + "g += 1;\n", there + "g += 1;\n"}),
              "");
}

TEST(BothSides, AStatementWithoutBracesInALambdaIsOneByItself) {
    const std::string kernel =
        "__global__ void k(float* r, int n) {\n    int i = blockIdx.x * blockDim.x + threadIdx.x;\n"
        "    if (i < n) r[i] = n;\n}\n";
    const std::string port =
        "void k(sycl::queue& q, float* r, int n) {\n    q.parallel_for(n, [=](sycl::nd_item<1> it) {\n"
        "        int i = it.get_global_id(0);\n        if (i < n) r[i] = n;\n    });\n}\n";
    const Edit guard = {"    if (i < n) r[i] = n;", "    if (i >= n) return;\n    r[i] = n;"};
    const auto now = [&](const Edit& there) {
        return found(kernel, port, replaced(kernel, guard.first, guard.second),
                     replaced(port, there.first, there.second), ".cpp");
    };
    EXPECT_EQ(now(guard), "");
    EXPECT_NE(now({guard.first, "    if (i > n) return;\n    r[i] = n;"}), "");
    EXPECT_NE(now({guard.first, "    if (i >= n) { return;\n    r[i] = n; }"}), "");
    EXPECT_NE(now({guard.first, "    if (i >= n) return; else r[i] = n;"}), "");
}

TEST(BothSides, ANewNameIsSpelledAsItsSiblingsAre) {
    const auto dispatch = [](const std::string& own, const std::string& more) {
        std::string out = "switch (m) {\n";
        for (const std::string each : {"case 0: x_OWN_add(n); break;\n", "case 1: x_OWN_mul(n); break;\n",
                                       "case 2: x_OWN_sub(n); break;\n", "case 4: x_OWN_div(n); break;\n"})
            out += replaced(each, "OWN", own);
        return "int f(int m, int n) {\n" + out + more + "default: break;\n}\nreturn m;\n}\n";
    };
    const std::string source = dispatch("gpu", ""), target = dispatch("cpu", "");
    const std::string now = dispatch("gpu", "case 5: x_gpu_neg(n); break;\n");
    EXPECT_EQ(found(source, target, now, dispatch("cpu", "case 5: x_cpu_neg(n); break;\n"), ".cpp"), "");
    for (const char* other :
         {"case 5: x_cpu_abs(n); break;\n", "case 6: x_cpu_neg(n); break;\n", "case 5: x_cpu_add(n); break;\n",
          "case 5: x_cpu_neg(m); break;\n", "case 5: y_cpu_neg(n); break;\n"})
        EXPECT_NE(found(source, target, now, dispatch("cpu", other), ".cpp"), "") << other;
}

TEST(BothSides, AStructThatGetsAFieldOfTheOtherHasCaughtUp) {
    const std::string source = "struct Photon {\n    float3 direction;\n    float power;\n};\n";
    const std::string target =
        "struct Photon {\n    float3 direction;\n    unsigned int light;\n    float power;\n    float weight;\n};\n";
    const auto now = [&](const std::string& from, const std::string& to) {
        return found(source, target, replaced(source, from, to), target, ".cpp");
    };
    EXPECT_EQ(now("    float power", "    uint light;\n    float power"), "");
    EXPECT_EQ(now("float power;", "float power;\n    float weight;"), "");
    for (const auto& [from, to] : std::vector<Edit>{{"float power;", "float power;\n    uint light;"},
                                                    {"    float power", "    int light;\n    float power"},
                                                    {"    float power", "    uint lights;\n    float power"},
                                                    {"    float power", "    uint light"},
                                                    {"    float power;\n", ""}})
        EXPECT_NE(now(from, to), "") << to;
}

/// A language may place a field by itself as another does where it is told to.
TEST(BothSides, AFieldThatIsNoLongerPlacedHasNotCaughtUp) {
    const std::string target = "struct Light {\n    float power;\n    vec3 direction;\n};\n",
                      placed = replaced(replaced(target, "vec3", "alignas(16) float3"), "float power",
                                        "alignas(8) float power"),
                      plain = replaced(target, "vec3", "float3");
    EXPECT_NE(found(placed, target, replaced(placed, "alignas(16) ", ""), target, ".cu"), "");
    EXPECT_NE(found(placed, target, plain, target, ".cu"), "");
    EXPECT_NE(found(placed, target, replaced(placed, "alignas(16)", "alignas(4)"), target, ".cu"), "");
    EXPECT_EQ(found(replaced(plain, "float3", "float4"), target, plain, target, ".cu"), "");
}

/// The matcher still takes them for the same.
TEST(BothSides, UnlikeFunctionsStillPairUnits) {
    const Dialect dialect;
    for (const auto& [one, other] : std::vector<std::pair<std::string, std::string>>{
             {"fmodf", "mod"}, {"rint", "round"}, {"__clz", "findMSB"}, {"__ffs", "findLSB"}, {"fabs", "abs"}}) {
        ASSERT_NE(dialect.find(one), nullptr);
        EXPECT_EQ(*dialect.find(one), *dialect.find(other)) << one;
        EXPECT_NE(*dialect.meaning(one), *dialect.meaning(other)) << one;
    }
}

}  // namespace
}  // namespace porttool::testing::both_sides_test
