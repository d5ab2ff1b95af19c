// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Edits whose place and words look sure and that are another thing in the port; beside each what is sure.
#include "tests/porttool/synced_repository.h"

namespace porttool::testing {
namespace sync_doubt_test {

class SyncDoubt : public SyncedRepository {};

TEST_F(SyncDoubt, WhatHipCallsOtherwiseHasItsNameThere) {
    const auto file = [](const std::string& run, const std::string& more) {
        return "int room(float** all, int n) {\n  " + run + "Malloc((void**)all, n);\n  " + run +
               "Memset(*all, 0, n);\n" + more + "  return n;\n}\n";
    };
    start("k.cu", file("cuda", ""), "k.hip", file("hip", ""));
    expect_ported(file("cuda",
                       "  cudaDeviceProp device;\n  cudaGetDeviceProperties(&device, 0);\n"
                       "  cudaHostAlloc((void**)all, n, cudaHostAllocMapped);\n"),
                  file("hip",
                       "  hipDeviceProp_t device;\n  hipGetDeviceProperties(&device, 0);\n"
                       "  hipHostMalloc((void**)all, n, hipHostMallocMapped);\n"));
}

const std::string kAsks =
    "int shape(const Picture* p, int n) {\n  int state = 0;\n  if (p->kind == PlainKind) state = rows(p, n);\n"
    "  if (p->kind == PlainKind) state += columns(p, n);\n  return state;\n}\n";

TEST_F(SyncDoubt, AValueThatIsAskedForInAnotherWayThereIsNotRenamed) {
    const std::string now = replaced(kAsks, "PlainKind", "NoKind");
    const std::string port =
        "int shape(const Picture* p, int n) {\n  int state = 0;\n  if (p->kind != PlainKind) return whole(p, n);\n"
        "  return state;\n}\n";
    start("k.c", kAsks, "k.cpp", port);
    const nlohmann::json got = proposal_of(now);
    EXPECT_NE(got["state"], "proposed") << got.dump(1);
}

TEST_F(SyncDoubt, AValueThatIsAskedForAlikeIsRenamed) {
    const std::string port =
        "int shape(const Picture* p, int n) {\n  int state = 0;\n  if (p->kind == PlainKind) state = rows(p, n);\n"
        "  if (p->kind == PlainKind) state += columns(p, n);\n  if (p->kind == PlainKind) tell(p);\n"
        "  return state;\n}\n";
    start("k.c", kAsks, "k.cpp", port);
    expect_ported(replaced(kAsks, "PlainKind", "NoKind"), replaced(port, "PlainKind", "NoKind"));
}

TEST_F(SyncDoubt, AnElementsTypeIsNotChangedWherePortStillSizesItByTheOldOne) {
    const auto file = [](const std::string& type, const std::string& own) {
        return "void spread(const float* x, int n) {\n  " + type + " *columns = (" + type + " *)malloc(n * sizeof(" +
               type + "));\n  fill(columns, x, n);\n" + own + "  free(columns);\n}\n";
    };
    start("k.c", file("int", ""), "k.cpp", file("int", "  q.memcpy(far, columns, n * sizeof(int));\n"));
    expect_left(file("size_t", ""), "still sizes it", 4);
}

TEST_F(SyncDoubt, AnElementsTypeChangesWhereTheRestIsSizedByIt) {
    const auto file = [](const std::string& type, const std::string& own) {
        return "void spread(const float* x, int n) {\n  " + type + " *columns = (" + type + " *)malloc(n * sizeof(" +
               type + "));\n  fill(columns, x, n);\n" + own + "  free(columns);\n}\n";
    };
    const std::string own = "  q.memcpy(far, columns, n * sizeof(*columns));\n";
    start("k.c", file("int", ""), "k.cpp", file("int", own));
    expect_ported(file("size_t", ""), file("size_t", own));
}

TEST_F(SyncDoubt, ALoopToAnotherEndDoesNotCountInTheNewType) {
    const auto file = [](const std::string& type, const std::string& end) {
        return "void spread(float* x, int rows, int rounds) {\n  for (" + type + " i = 0; i < " + end +
               "; i++) {\n    x[i] = 0.5f;\n  }\n}\n";
    };
    start("k.c", file("int", "rows"), "k.cpp", file("int", "rounds"));
    expect_left(file("size_t", "rows"), "runs to another end", 2);
}

TEST_F(SyncDoubt, ALoopToTheSameEndCountsInTheNewType) {
    const auto file = [](const std::string& type) {
        return "void spread(float* x, int rows) {\n  for (" + type +
               " i = 0; i < rows; i++) {\n    x[i] = 0.5f;\n  }\n}\n";
    };
    start("k.c", file("int"), "k.cpp", file("int"));
    expect_ported(file("size_t"), file("size_t"));
}

TEST_F(SyncDoubt, ADirectiveAloneIsNoNeighbourOfAField) {
    const std::string source =
        "struct Push {\n  uint size;\n#ifdef IDS\n  uint rows;\n#else\n  uint split;\n#endif\n  uint last;\n};\n";
    const auto port = [](const std::string& more) {
        return "struct Push {\n  uint size;\n#ifdef IDS\n  uint rows;\n#else\n" + more +
               "  ivec2 ne02;\n  float3 scale;\n  mat4 turn;\n#endif\n  uint last;\n};\n";
    };
    start("k.h", source, "k.cpp", port(""));
    expect_left(replaced(source, "  uint split", "  uint batches;\n  uint split"), "something else behind that", 5);
}

TEST_F(SyncDoubt, ANewBlockComesAroundWhatThePortHas) {
    const auto file = [](const std::string& call) {
        return "void sort(Work& done, int n) {\n  gather(done, n);\n" + call + "  hand_back(done, n);\n}\n";
    };
    start("k.cpp", file("  sort_rest<int>(done, n);\n"), "k.cu",
          file("  const int* rows = done.data();\n  const unsigned size = done.count;\n"));
    const nlohmann::json got = proposal_of(file("  if (n > 0)\n    sort_rest<int>(done, n);\n"));
    EXPECT_EQ(got["state"], "refused") << got.dump(1);
}

TEST_F(SyncDoubt, AMemberOfAClassOfTheStandardLibraryKeepsItsName) {
    const auto file = [](const std::string& most, const std::string& more) {
        return "int top(int a, int b) {\n  int c = " + most + "(a, b);\n  int d = " + most + "(c, 3);\n  c = " + most +
               "(c, d);\n" + more + "  return c;\n}\n";
    };
    start("k.cu", "#include <limits>\n" + file("max", ""), "k.hip", "#include <limits>\n" + file("TOP_MAX", ""));
    expect_ported("#include <limits>\n" + file("max", "  if (c == std::numeric_limits<int>::max()) c = 1;\n"),
                  "#include <limits>\n" + file("TOP_MAX", "  if (c == std::numeric_limits<int>::max()) c = 1;\n"));
}

TEST_F(SyncDoubt, ALibrarysSwitchIsNotThePorts) {
    const auto file = [](const std::string& run, const std::string& more) {
        return "void step(float* x, int n) {\n  " + run + "Memset(x, 0, n);\n" + more + "  " + run + "Free(x);\n}\n";
    };
    start("k.cu", file("cuda", ""), "k.hip", file("hip", ""));
    const nlohmann::json got = proposal_of(file("cuda", "#ifdef CUDNN_STEP\n  n = 2;\n#endif\n"));
    ASSERT_FALSE(got["left"].empty()) << got.dump(1);
    EXPECT_NE(got["left"][0]["message"].get<std::string>().find("CUDNN_STEP"), std::string::npos) << got.dump(1);
}

TEST_F(SyncDoubt, ADoubleIsNoWordOfADevicesFileThatHasNone) {
    const auto file = [](const std::string& type, const std::string& more) {
        return type + "4 turn(" + type + "4 z) {\n" + more + "  z.x = z.x * z.y;\n  return z;\n}\n";
    };
    start("k.cpp", file("Vector", ""), "k.cl", file("REAL", ""));
    expect_left(file("Vector", "  double part = z.x;\n"), "`double`", 1);
}

TEST_F(SyncDoubt, NewParametersGoBehindTheOneThatThePortCallsAlike) {
    const auto source = [](const std::string& more) {
        return "float shade(const Colour &colour, const float rough, const float sheen, const float tint,\n" + more +
               "    const Vector &light, const Vector &eye, float *pdf) {\n  return rough * sheen * tint;\n}\n";
    };
    const auto port = [](const std::string& more) {
        return "float shade(const Vector light, const Vector eye, float *pdf, const Colour colourVal,\n"
               "    const float roughVal, const float sheenVal, const float tintVal" +
               more + ") {\n  return roughVal * sheenVal * tintVal;\n}\n";
    };
    start("k.cpp", source(""), "k.cl", port(""));
    const nlohmann::json got = proposal_of(source("    const float depth, const float ior,\n"));
    ASSERT_TRUE(got["patch"].is_string()) << got.dump(1);
    EXPECT_NE(dense(got["patch"]).find("tintVal,constfloatdepth,constfloatior){"), std::string::npos) << got.dump(1);
}

TEST_F(SyncDoubt, AClockIsAskedBehindAWaitOfThePortsOwn) {
    const auto file = [](const std::string& copy, const std::string& more) {
        return "int run(sycl::queue& q, float* near, float* far, int n) {\n" + copy + more +
               "  report(near, n);\n  return n;\n}\n";
    };
    const std::string wait = "  q.memcpy(near, far, n);\n  q.wait();\n";
    start("k.cu", replaced(file("  cudaMemcpy(near, far, n, cudaMemcpyDeviceToHost);\n", ""), "sycl::queue& q, ", ""),
          "k.cpp", "#include <sycl/sycl.hpp>\n" + file(wait, ""));
    expect_ported(replaced(file("  cudaMemcpy(near, far, n, cudaMemcpyDeviceToHost);\n", "  int wrong = 0;\n"),
                           "sycl::queue& q, ", ""),
                  "#include <sycl/sycl.hpp>\n" + file(wait, "  int wrong = 0;\n"));
}

TEST_F(SyncDoubt, AClockThatStartsABlockIsAskedBeforeWhatTakesItsTime) {
    const auto file = [](const std::string& own, const std::string& more) {
        return "void bench(int n) {\n" + own + more + "  measure(n);\n}\n";
    };
    start("k.cpp", file("", ""), "k.cu", file("  prepare_device();\n", ""));
    expect_ported(file("", "  auto first = clock::now();\n"),
                  file("  prepare_device();\n", "  auto first = clock::now();\n"));
}

TEST_F(SyncDoubt, ALaunchInAnotherFormIsNothingToAPortWithoutOne) {
    const auto file = [](const std::string& launch, const std::string& scale) {
        return "void run(float* x, int n) {\n  int seen = 0;\n  " + launch + "\n  report(x, n, " + scale + ");\n}\n";
    };
    start("k.hip", file("hipLaunchKernelGGL(HIP_KERNEL_NAME(fill<3>), dim3(n), dim3(64), 0, 0, x, n);", "1e-9f"),
          "k.cpp", file("fill_all<3>(x, n);", "1e-9f"));
    expect_ported(file("fill<3><<<n, 64>>>(x, n);", "1e-6f"), file("fill_all<3>(x, n);", "1e-6f"));
}

TEST_F(SyncDoubt, ALaunchOfMoreThreadsIsNoOtherForm) {
    const auto file = [](const std::string& launch, const std::string& scale) {
        return "void run(float* x, int n) {\n  int seen = 0;\n  " + launch + "\n  report(x, n, " + scale + ");\n}\n";
    };
    start("k.hip", file("hipLaunchKernelGGL(fill, dim3(n), dim3(64), 0, 0, x, n);", "1e-9f"), "k.cpp",
          file("for (int i = 0; i < n; i++) x[i] = 0;", "1e-9f"));
    const nlohmann::json got = proposal_of(file("fill<<<n, 128>>>(x, n);", "1e-6f"));
    EXPECT_NE(got["state"], "proposed") << got.dump(1);
}

TEST_F(SyncDoubt, ANewSpellingOfAConstantIsCarriedWhereThePortSpeltItAlike) {
    const std::string kernel =
        "#include <math.h>\n#define PI 3.14159\nfloat wave(float x, float n) {\n  return sin(PI * x / n) * n;\n}\n";
    start("k.cu", kernel, "k.cpp", kernel);
    const std::string now = replaced(kernel, "sin(PI", "sin(M_PI");
    write(source_path, now);
    const std::string id = source_path + ":wave";
    const nlohmann::json got = nlohmann::json::parse(porttool({"sync", id, "--format", "json"}).out)["proposals"][0];
    ASSERT_EQ(got["state"], "proposed") << got.dump(1);
    EXPECT_NE(got["patch"].get<std::string>().find("+  return sin(M_PI * x / n) * n;"), std::string::npos);
}

TEST_F(SyncDoubt, ASpellingComesWithBracketsThatGo) {
    const auto file = [](const std::string& value) { return "int rows(int n, int b) {\n  return " + value + ";\n}\n"; };
    start("k.cu", file("(int)ceil((float)(n) / b) + 1"), "k.hip", file("(int)ceil((float)(n) / b) + 1"));
    expect_ported(file("(int)ceilf((float)n / b) + 2"), file("(int)ceilf((float)n / b) + 2"));
}

TEST_F(SyncDoubt, AQualifierWithoutAPlaceIsDueNowhere) {
    const auto file = [](const std::string& head, const std::string& scale) {
        return "void run(" + head + ") {\n  set_scale(n, " + scale + ");\n  finish(n);\n}\n";
    };
    start("k.cu", file("const float* x, float* out, int n", "2.0f"), "k.cpp", file("Rows rows, int n", "2.0f"));
    expect_ported(file("const float* __restrict__ x, float* __restrict__ out, int n", "3.0f"),
                  file("Rows rows, int n", "3.0f"));
}

TEST_F(SyncDoubt, ABlockOfThePortsOwnIsNotEmptied) {
    const auto file = [](const std::string& first, const std::string& second) {
        return "void run(float* x, int n) {\n  int seen = 0;\n" + first + second + "  report(x, n);\n}\n";
    };
    const auto held = [](const std::string& call) {
        return "  q.submit([&](handler& h) {\n    h.parallel_for(n, [=](item<1> i) {\n      " + call +
               "\n    });\n  });\n";
    };
    const std::string one = "tissue(i, x, n, 1);", two = "tissue(i, x, n, 2);";
    start("k.cu", file("  tissue(i, x, n, 1);\n", "  tissue(i, x, n, 2);\n"), "k.cpp", file(held(one), held(two)));
    const nlohmann::json got = proposal_of(file("", "  tissue(i, x, n, 2);\n"));
    EXPECT_NE(got["state"], "proposed") << got.dump(1);
}

TEST_F(SyncDoubt, ANewArgumentStandsBehindThePortsOwnAsOthersDo) {
    const auto file = [](const std::string& own, const std::string& more, const std::string& comma) {
        return "void run(" + own + "int n, int repeat) {\n  int seen = 0;\n  step<int>(" +
               (own.empty() ? "" : "q" + comma) + more + "repeat" + comma + "seen);\n}\n";
    };
    start("k.cu", file("", "", ", "), "k.cpp", file("queue& q, ", "", ", "));
    expect_written(file("", "n, ", ", "), file("queue& q, ", "n, ", ", "));
}

/// A host function with statements of the source's own, and a number that both sides have.
std::string counted(const std::string& own, const std::string& count) {
    return "int host(float* a, int n) {\n  prepare(a, n);\n" + own + "  finish(a, n * " + count +
           ");\n  return 0;\n}\n";
}

TEST_F(SyncDoubt, NamesDeclaredTogetherOrApartAreNothingToAPortThatHasThemNot) {
    start("k.cu", counted("  float* d_a;\n  float* d_b;\n  hand(&d_a, &d_b);\n", "2"), "k.cpp", counted("", "2"));
    const nlohmann::json got = proposal_of(counted("  float *d_a, *d_b;\n  hand(&d_a, &d_b);\n", "3"));
    EXPECT_NE(got["patch"].dump().find("n * 3"), std::string::npos) << got.dump(1);
    EXPECT_EQ(got["left"].dump().find("clearly stands for"), std::string::npos) << got.dump(1);
}

TEST_F(SyncDoubt, ADeclarationThatGoesIsNothingToAPortThatNeverHadTheName) {
    start("k.cu", counted("  dim3 blocks;\n  double spent[4];\n", "2"), "k.cpp", counted("", "2"));
    expect_ported(counted("", "3"), counted("", "3"));
}

TEST_F(SyncDoubt, ANameForWhatStoodThereIsNothingToAPortWithoutTheStatement) {
    const std::string copy = "  cudaMemcpy(d, a, n * sizeof(float), cudaMemcpyHostToDevice);\n";
    start("k.cu", counted(copy, "2"), "k.cpp", counted("", "2"));
    const std::string named = "  cudaMemcpy(d, a, bytes, cudaMemcpyHostToDevice);\n";
    const std::string size = "  size_t bytes = n * sizeof(float);\n";
    const auto tells_of_copy = [&](const std::string& own) {
        const nlohmann::json got = proposal_of(counted(own, "3"));
        return (got["left"].dump() + got["why"].dump()).find("clearly stands for `cudaMemcpy") != std::string::npos;
    };
    EXPECT_FALSE(tells_of_copy(size + named));
    EXPECT_TRUE(tells_of_copy("  size_t bytes = m * sizeof(float);\n" + named)) << "another value";
    EXPECT_TRUE(tells_of_copy("  size_t bytes = n * sizeof(float);\n  bytes += 4;\n" + named)) << "written behind it";
    EXPECT_TRUE(tells_of_copy("  size_t bytes = n * sizeof(float);\n  n = 4;\n" + named)) << "made of what is written";
    EXPECT_TRUE(tells_of_copy("  size_t bytes = n * sizeof(float);\n" + replaced(named, "bytes", "bytes + 1")));
}

TEST_F(SyncDoubt, AnotherTypeOrAValueOfWhatIsDeclaredIsTold) {
    start("k.cu", counted("  float* d_a;\n  float* d_b;\n  hand(&d_a, &d_b);\n", "2"), "k.cpp", counted("", "2"));
    expect_left(counted("  double *d_a, *d_b;\n  hand(&d_a, &d_b);\n", "3"), "d_a", 2);
    expect_left(counted("  float *d_a = first(n), *d_b;\n  hand(&d_a, &d_b);\n", "3"), "d_a", 2);
}

TEST_F(SyncDoubt, AStatementThatBeginsWithNoNameDeclaresNothing) {
    start("k.cu", counted("  (*hand)(a, n);\n  ++(*a);\n  ;\n", "2"), "k.cpp", counted("", "2"));
    expect_left(counted("  (*hand)(a, n + 1);\n", "3"), "hand", 2);
}

TEST_F(SyncDoubt, ADeclarationWithAValueThatGoesIsTold) {
    start("k.cu", counted("  float spent = measure(n);\n", "2"), "k.cpp", counted("", "2"));
    expect_left(counted("", "3"), "lost", 2);
}

TEST_F(SyncDoubt, AnObjectThatGoesIsTold) {
    start("k.cu", counted("  Stopwatch watch;\n", "2"), "k.cpp", counted("", "2"));
    expect_left(counted("", "3"), "lost", 2);
}

TEST_F(SyncDoubt, WhatNothingTellsIsAskedOnce) {
    const auto checked = [](const std::string& check, const std::string& end) {
        return "int host(float* a, int n) {\n  " + check + "prepare(a, n)" + end + ";\n  " + check + "work(a, n)" +
               end + ";\n  " + check + "finish(a, n)" + end + ";\n  return 0;\n}\n";
    };
    start("k.cu", checked("", ""), "k.cpp", checked("", ""));
    const nlohmann::json got = proposal_of(checked("CUDA_MUST(", ")"));
    ASSERT_EQ(got["left"].size(), 1) << got.dump(1);
    EXPECT_NE(got["left"][0]["message"].get<std::string>().find("`CUDA_MUST` (and so beside line 3, 4 of the port)"),
              std::string::npos)
        << got.dump(1);
}

TEST_F(SyncDoubt, AMethodIsTheFunctionThatTheLanguageHasOfVectors) {
    const auto fold = [](const std::string& head, const std::string& more) {
        return head + " {\n  float r = 2.0f;\n" + more + "  return r;\n}\n";
    };
    const std::string cpp = "float fold(Vector4 z, float k)", cl = "float fold(float4 z, float k)";
    start("k.cpp", fold(cpp, ""), "k.cl", fold(cl, ""));
    expect_ported(fold(cpp, "  r = z.Length() * k + z.Dot(z);\n"), fold(cl, "  r = length(z) * k + dot(z, z);\n"));
}

TEST_F(SyncDoubt, AMethodStaysOneWhereVectorsAreOfALibrary) {
    const auto fold = [](const std::string& more) {
        return "float fold(Vector4 z, float k) {\n  float r = 2.0f;\n" + more + "  return r;\n}\n";
    };
    start("k.cpp", fold(""), "k.cu", fold(""));
    const nlohmann::json got = proposal_of(fold("  r = z.Length() * k;\n"));
    EXPECT_EQ(got.dump().find("length("), std::string::npos) << got.dump(1);
}

TEST_F(SyncDoubt, AFunctionOfCNeedsNoScopeWhereThePortHasOthersInStd) {
    const auto file = [](const std::string& more) {
        return "float most(const float* a) {\n  return std::max(a[0], a[1]);\n}\nint host(const float* a, int n) {\n"
               "  float last = a[n];\n" +
               more + "  return last > n;\n}\n";
    };
    start("k.cu", file(""), "k.cpp", file(""));
    const std::string more = "  if (fabs(a[1] - last) > 0.5f) return 0;\n";
    expect_ported(file(more), file(more));
}

TEST_F(SyncDoubt, AFunctionOfCIsNotTakenForOneOfAScopeOfItsOwn) {
    const auto host = [](const std::string& scope, const std::string& more) {
        return "int host(const float* a, int n) {\n  float most = " + scope + "max(a[0], 1.0f);\n" + more +
               "  return most > n;\n}\n";
    };
    start("k.cu", host("", ""), "k.cpp", host("sycl::", ""));
    const nlohmann::json got = proposal_of(host("", "  if (fabs(a[1] - most) > 0.5f) return 0;\n"));
    EXPECT_EQ(got.dump().find("+  if (fabs"), std::string::npos) << got.dump(1);
}

TEST_F(SyncDoubt, WhatThePortSaysOfOneNameWithoutStdIsNoExampleOfAnother) {
    const auto host = [](const std::string& scope, const std::string& more) {
        return "int host(const float* a, int n) {\n  float most = " + scope + "max(a[0], a[1]);\n  most = " + scope +
               "max(most, a[2]);\n" + more + "  return most > n;\n}\n";
    };
    start("k.cu", host("std::", ""), "k.cpp", host("", ""));
    expect_ported(host("std::", "  most = std::max(most, a[3]);\n" +
                                    std::string("  auto now = std::chrono::steady_clock::now();\n")),
                  host("", "  most = max(most, a[3]);\n  auto now = std::chrono::steady_clock::now();\n"));
}

TEST_F(SyncDoubt, ADirectiveDoesNotGoWithoutItsEnd) {
    const auto timed = [](const std::string& ask, const std::string& end) {
        return "int host(float* a, int n) {\n" + ask + "  begin(a);\n" + end + "  work(a, n);\n  return 0;\n}\n";
    };
    const std::string ask = "#ifdef TIMED\n", end = "#endif\n";
    start("k.cu", timed(ask, end), "k.cpp", replaced(timed(ask, end), "  work", ask + "  tell(a);\n" + end + "  work"));
    const nlohmann::json got = proposal_of(replaced(timed("", ""), "n)", "n * 2)"));
    const std::string patch = got["patch"].is_string() ? got["patch"].get<std::string>() : "";
    EXPECT_EQ(patch.find("-#endif") == std::string::npos, patch.find("-#ifdef") == std::string::npos) << got.dump(1);
}

TEST_F(SyncDoubt, WhatALanguageSaysOfItsThreadsIsNoNameFromElsewhere) {
    const auto sum = [](const std::string& head, const std::string& id, const std::string& width) {
        return head + "sum(float* a, int n) {\n  int lane = " + id + " % " + width +
               ";\n  float v = a[lane];\n  if (lane == 0) a[n] = v * 2.0f;\n}\n";
    };
    start("k.cu", sum("__global__ void ", "threadIdx.x", "32"), "k.cpp", sum("void ", "item.get_local_id(0)", "32"));
    expect_left(sum("__global__ void ", "threadIdx.x", "warpSize"), "warpSize", 2);
}

TEST_F(SyncDoubt, HipSaysTheSameOfItsThreads) {
    const auto sum = [](const std::string& width) {
        return "__global__ void sum(float* a, int n) {\n  int lane = threadIdx.x % " + width +
               ";\n  float v = a[lane];\n  if (lane == 0) a[n] = v * 2.0f;\n}\n";
    };
    start("k.cu", sum("32"), "k.hip", sum("32"));
    expect_ported(sum("warpSize"), sum("warpSize"));
}

TEST_F(SyncDoubt, WhatCudaHasOfWarpsIsNotHips) {
    const auto sum = [](const std::string& more) {
        return "__global__ void sum(float* a, int n) {\n  float v = a[threadIdx.x];\n" + more + "  a[n] = v;\n}\n";
    };
    const auto host = [](const std::string& runtime) {
        return "void host(float* a) {\n  " + runtime + "Free(a);\n}\n";
    };
    start("k.cu", host("cuda") + sum(""), "k.hip", host("hip") + sum(""));
    expect_left(host("cuda") + sum("  __syncwarp();\n"), "__syncwarp", 5);
    expect_ported(host("cuda") + sum("  __syncthreads();\n"), host("hip") + sum("  __syncthreads();\n"));
}

TEST_F(SyncDoubt, ATextThatNamesAFunctionOfTheOtherRunTimeIsLeft) {
    const auto host = [](const std::string& runtime, const std::string& more) {
        return "void host(float* a) {\n  " + runtime + "Free(a);\n" + more + "  last(a);\n}\n";
    };
    start("k.cu", host("cuda", ""), "k.hip", host("hip", ""));
    expect_left(host("cuda", "  printf(\"cudaHostAlloc: %d\\n\", 1);\n"), "cudaHostAlloc", 2);
}

class SyncOfAMacro : public SyncedRepository {
protected:
    void SetUp() override {
        SyncedRepository::SetUp();
        write(source_path = "src/k.cu", kSource);
        write(port_path = "port/k.h", kPort);
        ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
        for (const std::string pair : {"src/k.cu:shade=port/k.h:shade", "src/k.cu:tint=port/k.h:DEFINE"})
            ASSERT_EQ(porttool({"accept", pair}).exit_code, 0);
        commit("in step");
    }
    const std::string kSource =
        "float shade(float x) {\n  return x * 2.0f;\n}\nfloat tint(float x) {\n  return x + 4.0f;\n}\n";
    const std::string kPort =
        "#define shade(x) ((x) * 2.0f)\n#define DEFINE(name) float name(float x) { \\\n  return x + 4.0f; \\\n}\n"
        "DEFINE(tint)\n";
};

TEST_F(SyncOfAMacro, WhatStaysOnItsLineIsCarried) {
    expect_written(replaced(kSource, "4.0f", "5.0f"), replaced(kPort, "4.0f", "5.0f"));
}

TEST_F(SyncOfAMacro, ANewLineIsLeft) {
    expect_left(replaced(kSource, "  return x + 4.0f;", "  float y = x + 4.0f;\n  return y * y;"), "behind a backslash",
                3);
}

TEST_F(SyncOfAMacro, AnExpressionThatTheSourceReturnsIsLeft) {
    expect_left(replaced(kSource, "2.0f", "3.0f"), "nothing that clearly stands for", 1);
}

}  // namespace sync_doubt_test
}  // namespace porttool::testing
