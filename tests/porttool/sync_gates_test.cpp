// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Edits of pairs that go ways of their own: what must not be written, and beside each what must.
#include <sstream>

#include "porttool/sync/scopes.h"
#include "porttool/sync/text_literals.h"
#include "tests/porttool/synced_repository.h"

namespace porttool::testing {
namespace sync_gates_test {

class SyncGates : public SyncedRepository {};

const std::string kRows =
    "float total(const float* a, float* out, int n) {\n  for (int i = 0; i < n; i++) out[i] = a[i] % 7;\n"
    "  double sum = 0;\n  for (int i = 0; i < n; i++) sum += out[i];\n  return sum;\n}\n";
const std::string kOtherRows =
    "float total(const float* a, float* out, int n) {\n  for (int i = 0; i < n; i++) out[i] = a[i] % 7;\n"
    "  for (int i = 0; i < n; i++) use(out[i], 2);\n  double sum = 0;\n  for (const float x : rows(out, n)) sum += x;\n"
    "  return sum;\n}\n";

TEST_F(SyncGates, ALoopOfWhichThePortHasNothingKeepsItsHead) {
    start("k.c", kRows, "k.cpp", kOtherRows);
    const nlohmann::json got = proposal_of(replaced(kRows, "int i = 0; i < n; i++) sum", "int i = 1; i < n; i++) sum"));
    EXPECT_EQ(got["state"], "refused") << got.dump(1);
}

TEST_F(SyncGates, ALoopThatThePortRepeatsTheSameInGetsTheNewHead) {
    start("k.c", kRows, "k.cpp", kOtherRows);
    expect_ported(replaced(kRows, "int i = 0; i < n; i++) out", "int i = 1; i < n; i++) out"),
                  replaced(kOtherRows, "int i = 0; i < n; i++) out", "int i = 1; i < n; i++) out"));
}

const std::string kChannels =
    "vec3 limit(vec3 c, float gain) {\n  c = c * gain;\n"
    "  for (int k = 0; k < 3; ++k) c[k] = clamp(c[k], 0.0f, 1.0f);\n  return c;\n}\n";

TEST_F(SyncGates, AStatementOfALoopIsNotOneOfThree) {
    start("k.glsl", kChannels, "k.cpp",
          "Color limit(Color c, float gain) {\n  c = c * gain;\n  c.r = std::clamp(c.r, 0.0f, 1.0f);\n"
          "  c.g = std::clamp(c.g, 0.0f, 1.0f);\n  c.b = std::clamp(c.b, 0.0f, 1.0f);\n  return c;\n}\n");
    const nlohmann::json got = proposal_of(replaced(kChannels, "0.0f, 1.0f", "0.0f, 2.0f"));
    EXPECT_EQ(got["state"], "refused") << got.dump(1);
}

TEST_F(SyncGates, AStatementOfALoopThatIsOneThereIsChanged) {
    const std::string port =
        "Color limit(Color c, float gain) {\n  c = c * gain;\n"
        "  for (int k = 0; k < 3; ++k) c[k] = std::clamp(c[k], 0.0f, 1.0f);\n  return c;\n}\n";
    start("k.glsl", kChannels, "k.cpp", port);
    expect_ported(replaced(kChannels, "0.0f, 1.0f", "0.0f, 2.0f"), replaced(port, "0.0f, 1.0f", "0.0f, 2.0f"));
}

std::string sorted(const std::string& last, bool at_once) {
    const std::string swap = "      int t = v[a];\n      v[a] = v[b];\n      v[b] = " + last + ";\n";
    return "void sort(int* v, int n) {\n  for (int a = 0; a < n; a++) {\n    int b = a;\n"
           "    for (int k = a + 1; k < n; k++) {\n      if (v[k] < v[b]) b = k;\n" +
           (at_once ? swap + "    }\n" : "    }\n" + swap) + "  }\n}\n";
}

TEST_F(SyncGates, AStatementOfAnInnerLoopIsNotDoneAsOften) {
    start("k.cu", sorted("t", false), "k.c", sorted("t", true));
    const nlohmann::json got = proposal_of(sorted("t + 1", false));
    EXPECT_EQ(got["state"], "refused") << got.dump(1);
}

TEST_F(SyncGates, AStatementOfTheSameLoopIs) {
    start("k.cu", sorted("t", false), "k.c", sorted("t", false));
    expect_ported(sorted("t + 1", false), sorted("t + 1", false));
}

const std::string kSearch =
    "int find(const int* keys, int n, int key) {\n  int low = 0, high = n;\n"
    "  while (low < high) low += step(keys, key);\n  return low;\n}\n";

TEST_F(SyncGates, WhatIsAddedToAValueThatThePortLacksIsLeft) {
    start("k.c", kSearch, "k.cpp",
          "int find(const int* keys, int n, int key) {\n  int low = 0;\n  while (low < n) low += step(keys, key);\n"
          "  return low;\n}\n");
    expect_left(replaced(kSearch, "high = n;", "high = n - 1;"), "nothing there that it goes on from", 2);
}

TEST_F(SyncGates, WhatIsAddedToAValueThatThePortHasIsCarried) {
    start("k.c", kSearch, "k.cpp", kSearch);
    expect_ported(replaced(kSearch, "high = n;", "high = n - 1;"), replaced(kSearch, "high = n;", "high = n - 1;"));
}

TEST_F(SyncGates, AFunctionOfThePortsOwnDoesNotGoForOneThatItHasNot) {
    const auto file = [](const std::string& call) {
        return "void Core::SetSky(const float* pixels, int width, int height) {\n  delete sky;\n"
               "  sky = new Buffer(pixels);\n  " +
               call + "(width, height);\n  skyWidth = width;\n}\n";
    };
    start("k.cpp", file("SetSkySize"), "p.cpp",
          "void Core::SetSky(const float* pixels, int width, int height) {\n  delete sky;\n  sky = new Image(device);\n"
          "  sky->SetData(rows, width, height);\n  sky->Bind(table);\n}\n");
    const nlohmann::json got = proposal_of(file("stageSkySize"));
    EXPECT_EQ(got["state"], "refused") << got.dump(1);
}

TEST_F(SyncGates, AFunctionThatBothCallGoesForItsNewName) {
    const auto file = [](const std::string& call, const std::string& type) {
        return "void Core::SetSky(const float* pixels, int width, int height) {\n  delete sky;\n  sky = new " + type +
               ";\n  " + call + "(width, height);\n  sky->Bind(table);\n}\n";
    };
    start("k.cpp", file("SetSkySize", "Buffer(pixels)"), "p.cpp", file("SetSkySize", "Image(device)"));
    expect_ported(file("stageSkySize", "Buffer(pixels)"), file("stageSkySize", "Image(device)"));
}

TEST_F(SyncGates, WhatGoesWithANameIsNamedWhereThePortHasThat) {
    const auto file = [](const std::string& made, const std::string& freed) {
        return "int run(int n) {\n  int* h_rows = take(n);\n  int* h_ids = take(n);\n" + made +
               "  work(h_rows, h_ids, n);\n" + freed + "  return 0;\n}\n";
    };
    start("k.cu", file("  int* d_ids;\n  cudaMalloc((void**)&d_ids, n);\n", "  cudaFree(d_ids);\n"), "k.cpp",
          "int run(int n) {\n  int* h_rows = take(n);\n  int* h_ids = take(n);\n  note(h_rows);\n  note(h_ids);\n"
          "  note(n);\n  sycl::buffer<int, 1> d_ids(h_ids, n);\n  work(h_rows, h_ids, n);\n  return 0;\n}\n");
    const nlohmann::json got = proposal_of(file("", ""));
    ASSERT_FALSE(got["left"].empty()) << got.dump(1);
    for (const nlohmann::json& item : got["left"]) EXPECT_EQ(item["target_line"], 7) << item.dump(1);
}

std::string copied(const std::string& bytes, const std::string& size, const std::string& scale) {
    return "void run(float* a, float* d_a, int n) {\n" + bytes + "  cudaMemcpy(d_a, a, " + size +
           ", cudaMemcpyHostToDevice);\n  work(a, n, " + scale + ");\n}\n";
}

TEST_F(SyncGates, ANameForAProductIsNothingWhicheverFactorComesFirst) {
    const std::string port =
        "void run(float* a, int n) {\n  const size_t bytes = n * sizeof(float);\n  note(bytes);\n"
        "  work(a, n, 0.5f);\n}\n";
    start("k.cu", copied("  note(0);\n", "sizeof(float) * n", "0.5f"), "k.cpp", port);
    const nlohmann::json got =
        proposal_of(copied("  note(0);\n  const size_t bytes = n * sizeof(float);\n", "bytes", "0.25f"));
    for (const nlohmann::json& item : got["left"])
        EXPECT_EQ(item["message"].get<std::string>().find("clearly stands for"), std::string::npos) << item.dump(1);
}

TEST_F(SyncGates, ANameForAnotherProductIsTold) {
    start("k.cu", copied("", "sizeof(float) * n", "0.5f"), "k.cpp",
          "void run(float* a, int n) {\n  work(a, n, 0.5f);\n}\n");
    expect_left(copied("  const size_t bytes = n * sizeof(double);\n", "bytes", "0.5f"), "bytes", 1);
}

TEST_F(SyncGates, ANewFieldHasTheTypeOfItsNeighboursThere) {
    const auto file = [](const std::string& type, const std::string& other, const std::string& more) {
        return "struct Material {\n  " + type + " shine;\n  " + type + " glow;\n" + more + "  " + type + " rough;\n  " +
               other + " height;\n  " + other + " depth;\n};\n";
    };
    start("k.h", file("cl_float", "cl_float", ""), "k.hpp", file("float", "double", ""));
    expect_ported(file("cl_float", "cl_float", "  cl_float glitter;\n"), file("float", "double", "  float glitter;\n"));
}

TEST_F(SyncGates, ANewFieldBetweenTwoTypesIsLeft) {
    const auto file = [](const std::string& type, const std::string& other, const std::string& more) {
        return "struct Material {\n  " + type + " shine;\n  " + type + " glow;\n  " + type + " rough;\n" + more + "  " +
               other + " height;\n  " + other + " depth;\n  " + other + " width;\n};\n";
    };
    start("k.h", file("cl_float", "cl_float", ""), "k.hpp", file("float", "double", ""));
    const nlohmann::json got = proposal_of(file("cl_float", "cl_float", "  cl_float glitter;\n"));
    EXPECT_EQ(got["state"], "refused") << got.dump(1);
}

/// A variable that is made of what the port has not, once the source moved it.
TEST_F(SyncGates, APartKeepsWhatDeclaresWhatIsUsedStill) {
    const std::string own = "__device__ int only_here(int n) { return n + 1; }\n";
    const auto file = [](const std::string& first, const std::string& size) {
        return "__global__ void run(int* a, int n) {\n" + first + "  mark(a, n);\n  fill(a, n);\n" + size +
               "  work(a, size, n);\n}\n";
    };
    start("k.cu", own + file("  int size = n * 2;\n", ""), "k.cl",
          "__kernel void run(__global int* a, int n) {\n  int size = n * 2;\n  mark(a, n);\n  fill(a, n);\n"
          "  work(a, size, n);\n}\n");
    const nlohmann::json got = proposal_of(own + file("  note(a, n);\n", "  int size = only_here(n) * 2;\n"));
    EXPECT_NE(got["state"], "proposed") << got.dump(1);
    const std::string patch = got["patch"].is_null() ? "" : got["patch"];
    EXPECT_EQ(patch.find("-  int size"), std::string::npos) << got.dump(1);
}

TEST(SyncScopes, NamesThatAnEditDeclaresTwice) {
    const auto words = [](const std::string& text) {
        std::vector<std::string> out;
        std::istringstream in(text);
        for (std::string word; in >> word;) out.push_back(word);
        return out;
    };
    const auto doubled = [&](const std::string& before, const std::string& now) {
        return names_doubled(words("void @ ( ) { " + before + " }"), words("void @ ( ) { " + now + " }"));
    };
    EXPECT_EQ(doubled("int a = 1 ;", "int a = 1 ; double * a = f ( ) ;"), std::set<std::string>{"a"});
    EXPECT_EQ(doubled("double * a , * b ;", "double * a , * b ; double * a = f ( ) ;"), std::set<std::string>{"a"});
    // In blocks of their own, in heads of loops, written again, and twice before.
    EXPECT_TRUE(doubled("int a = 1 ;", "int a = 1 ; { int a = 2 ; }").empty());
    EXPECT_TRUE(doubled("", "for ( int i = 0 ; i < 3 ; ++ i ) { } for ( int i = 0 ; i < 3 ; ++ i ) { }").empty());
    EXPECT_TRUE(doubled("int a = 1 ;", "int a = 1 ; a = 2 ; return a ;").empty());
    EXPECT_TRUE(doubled("int a ; int a ;", "int a ; int a ;").empty());
    EXPECT_TRUE(doubled("", "auto a = f < half , b > ( ) ; auto c = f < half , b > ( ) ;").empty());
}

TEST_F(SyncGates, ANumberThatMovesIsSpelledAsItWas) {
    const auto file = [](const std::string& first, const std::string& last) {
        return "double run(double a, double b) {\n" + first + "  mark(a);\n  note(b);\n" + last + "  return a;\n}\n";
    };
    const std::string moved = "  a = a / 1000000.0 + b;\n";
    start("k.c", file(moved, ""), "k.cpp", file(moved, ""));
    expect_written(file("", moved), file("", moved));
}

TEST_F(SyncGates, AWordStandsAsTheOneDidThatItComesFor) {
    start("k.c",
          "float f(int n) {\n  float sum = g(n);\n  sum *= (float)(1 << n) / (float)((1 << (n + 1)) - 1);\n"
          "  return sum;\n}\n",
          "k.cl",
          "float f(int n) {\n  float sum = g(n);\n  sum *= ((float)(1<<n)/(float)((1<<(n+1))-1));\n"
          "  return sum;\n}\n");
    const nlohmann::json got = proposal_of(
        "float f(int n) {\n  float sum = g(n);\n  sum *= (float)(1u << n) / (float)((1u << (n + 1)) - 1u);\n"
        "  return sum;\n}\n");
    EXPECT_NE(got["patch"].get<std::string>().find("((float)(1u<<n)/(float)((1u<<(n+1))-1u))"), std::string::npos)
        << got.dump(1);
}

TEST(SyncTexts, WhatChangedInATextChangesInAnother) {
    const auto made = [](const std::string& was, const std::string& is, const std::string& there) {
        return literal_changed_alike({was, is, there});
    };
    EXPECT_EQ(made("\"CUDA assert: %s %d\\n\"", "\"CUDA error: %s %d\\n\"", "\"HIP assert: %s %d\\n\""),
              "\"HIP error: %s %d\\n\"");
    EXPECT_EQ(made("\"btyes to device\"", "\"bytes to device\"", "\"btyes to queue\""), "\"bytes to queue\"");
    // Not there, there twice, within another word, or with another value.
    EXPECT_EQ(made("\"CUDA assert: %s\"", "\"CUDA error: %s\"", "\"HIP failure: %s\""), "");
    EXPECT_EQ(made("\"a time: %f\"", "\"a span: %f\"", "\"b time: time: %f\""), "");
    EXPECT_EQ(made("\"a time: %f\"", "\"a span: %f\"", "\"b uptime: %f\""), "");
    EXPECT_EQ(made("\"a time: %f\"", "\"a span: %d\"", "\"b time: %f\""), "");
    EXPECT_EQ(made("\"a time: %f\"", "\"a span: %f\"", "\"b time: %d\""), "");
}

}  // namespace sync_gates_test
}  // namespace porttool::testing
