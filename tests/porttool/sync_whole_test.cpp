// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What an edit needs beyond its own statement: a name throughout, a value that is given, both ends of a block.
#include "tests/porttool/synced_repository.h"

namespace porttool::testing {
namespace sync_whole_test {

class SyncWhole : public SyncedRepository {
protected:
    nlohmann::json proposals_of(const std::string& now, std::vector<std::string> arguments = {"sync"}) {
        write(source_path, now);
        arguments.insert(arguments.end(), {"--format", "json"});
        return nlohmann::json::parse(porttool(arguments).out)["proposals"];
    }
    void expect_step() { EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0) << porttool({"check"}).out; }
};

std::string steps(const std::string& declared) {
    return "int run(int count, char** argv) {\n" + declared +
           "  const int all = rows * columns;\n  for (int i = 0; i < all; i++) step(i, rows);\n  return all;\n}\n";
}
const std::string kFixed = "  const int rows = 400;\n  const int columns = 100;\n";

TEST_F(SyncWhole, AConstantThatIsDeclaredAnewIsNotWritten) {
    start("k.c", steps(kFixed), "k.cpp", steps(kFixed));
    const std::string given =
        "  if (count != 3) {\n    return 1;\n  }\n  const int columns = atoi(argv[1]);\n"
        "  const int rows = atoi(argv[2]);\n";
    expect_ported(steps(given), steps(given));
}

TEST_F(SyncWhole, AConstantOfThePortIsNotWrittenTo) {
    start("k.c", steps("  int rows = 400;\n  const int columns = 100;\n"), "k.cpp", steps(kFixed));
    expect_left(steps("  int rows = 400;\n  const int columns = 100;\n  rows = atoi(argv[2]);\n"), "const", 3);
}

std::string attention(const std::string& head, const std::string& function) {
    return head +
           "void weigh(const float* a, float* out, int n) {\n  int i = blockIdx.x;\n  if (i < n) out[i] = " + function +
           "(a[i]) / n;\n}\n";
}

TEST_F(SyncWhole, AHeaderWithKernelsHasTheFunctionsOfDevices) {
    start("k.cu", attention("__global__ ", "expf"), "k.h", attention("__global__ ", "expf"));
    expect_ported(attention("__global__ ", "__expf"), attention("__global__ ", "__expf"));
}

TEST_F(SyncWhole, AHeaderOfTheHostHasNone) {
    const std::string port =
        "inline void weigh(const float* a, float* out, int n) {\n"
        "  for (int i = 0; i < n; i++) out[i] = expf(a[i]) / n;\n}\n";
    start("k.cu", attention("__global__ ", "expf"), "k.h", port);
    for (const nlohmann::json& one : proposals_of(attention("__global__ ", "__expf")))
        EXPECT_NE(one["state"], "proposed") << one.dump(1);
}

std::string chance(const std::string& type, const std::string& value, bool is_asked) {
    return type + " chance(" + type + " x) {\n  return " +
           (is_asked ? "x > 0.f ? " + value + " : 0.f" : "x == 0.f ? 0.f : " + value) + ";\n}\n";
}

TEST_F(SyncWhole, ANumberThatThePortSaysInItsOwnWordsIsWrittenAsThere) {
    start("k.c", chance("float", "(kTwo * kOne / x)", false), "k.cl",
          chance("float", "((1.f / (2.f * M_PI_F)) * M_1_PI_F / x)", false));
    expect_ported(chance("float", "(kTwo * kOne / x)", true),
                  chance("float", "((1.f / (2.f * M_PI_F)) * M_1_PI_F / x)", true));
}

std::string curve(const std::string& name, const std::string& more = "") {
    return "float " + name + "(float x) {\n  return 1.0f / (1.0f + exp(-x));\n}\n" + more +
           "float best(const float* a, int n) {\n  float most = " + name +
           "(a[0]);\n  for (int i = 1; i < n; i++) most = max(most, " + name + "(a[i]));\n  return most;\n}\n";
}

TEST_F(SyncWhole, ANewNameOfAFunctionIsFollowedWhereSomebodyAsks) {
    start("k.c", curve("curve"), "k.cpp", curve("curve"));
    EXPECT_TRUE(proposals_of(curve("curvef")).empty()) << "in step as it is";
    const nlohmann::json got = proposals_of(curve("curvef"), {"sync", "src/k.c:best"});
    ASSERT_EQ(got[0]["state"], "proposed") << got.dump(1);
    ASSERT_EQ(porttool({"sync", "src/k.c:best", "--apply"}).exit_code, 0);
    EXPECT_EQ(port_now(), curve("curvef"));
    expect_step();
}

TEST_F(SyncWhole, ANewNameIsNotFollowedToOtherFiles) {
    write("port/l.cpp", "float other(float x) {\n  return 2.0f * curve(x);\n}\n");
    start("k.c", curve("curve"), "k.cpp", curve("curve"));
    const nlohmann::json got = proposals_of(curve("curvef"), {"sync", "src/k.c:best"});
    EXPECT_EQ(got[0]["state"], "already") << got.dump(1);
}

TEST_F(SyncWhole, ANewNameIsNotTakenFromSomethingElse) {
    const std::string own = "float curvef(float x) {\n  return x * x;\n}\n";
    start("k.c", curve("curve"), "k.cpp", curve("curve", own));
    const nlohmann::json got = proposals_of(curve("curvef"), {"sync", "src/k.c:best"});
    EXPECT_EQ(got[0]["state"], "already") << got.dump(1);
}

std::string rounds(const std::string& before, const std::string& within) {
    return before + "int run(int count, char** argv) {\n" + within +
           "  for (int i = 0; i < ROUNDS; i++) step(i);\n  return 0;\n}\n";
}

TEST_F(SyncWhole, AMacroOfThePortIsNoNameOfALocal) {
    start("k.c", rounds("#define ROUNDS 10\n", ""), "k.cpp", rounds("#define ROUNDS 10\n", ""));
    const nlohmann::json got = proposal_of(rounds("", "  const int ROUNDS = atoi(argv[1]);\n"));
    EXPECT_NE(got["state"], "proposed") << got.dump(1);
}

TEST_F(SyncWhole, ALocalThatWasNoMacroThereComes) {
    const std::string other = "#define ROUNDS_AT_MOST 10\n";
    start("k.c", replaced(rounds(other, ""), "i < ROUNDS", "i < 10"), "k.cpp",
          replaced(rounds(other, ""), "i < ROUNDS", "i < 10"));
    expect_ported(rounds(other, "  const int ROUNDS = atoi(argv[1]);\n"),
                  rounds(other, "  const int ROUNDS = atoi(argv[1]);\n"));
}

std::string drawn(bool gives, const std::string& wait) {
    return std::string(gives ? "double" : "void") + " draw(float* a, int n) {\n" +
           (gives ? "  double start = clock_now();\n" : "") + "  fill(a, n);\n" + wait +
           (gives ? "  double end = clock_now();\n  return end - start;\n" : "") + "}\n";
}
std::string drawn_in(bool gives) {
    return "int run(float* a, int n) {\n  int rounds = 3;\n" + std::string(gives ? "  double all = 0;\n" : "") +
           "  for (int i = 0; i < rounds; i++)\n    " + (gives ? "all += " : "") + "draw(a, n);\n" +
           (gives ? "  printf(\"%f\\n\", all);\n" : "") + "  return rounds;\n}\n";
}

TEST_F(SyncWhole, TheValueOfAFunctionIsTakenWhereItsPortGivesOne) {
    start("k.c", drawn(false, "") + drawn_in(false), "k.cpp", drawn(false, "") + drawn_in(false));
    for (const nlohmann::json& one : proposals_of(drawn(true, "") + drawn_in(true))) {
        EXPECT_EQ(one["state"], "proposed") << one.dump(1);
        EXPECT_TRUE(one["why"].empty()) << one.dump(1);
    }
}

TEST_F(SyncWhole, AValueThatIsNotGivenYetIsTold) {
    const std::string own = "  if (n > 8) {\n    tell(a);\n    return;\n  }\n";
    start("k.c", drawn(false, "") + drawn_in(false), "k.cpp", drawn(false, own) + drawn_in(false));
    const nlohmann::json got = proposals_of(drawn(true, "") + drawn_in(true));
    EXPECT_NE(got[0]["state"], "proposed") << got.dump(1);
    EXPECT_NE(got[1]["why"].dump().find("draw"), std::string::npos) << got.dump(1);
}

TEST_F(SyncWhole, APartOfAPortDoesWithoutAValueThatIsNotGiven) {
    const std::string mine = "#define MINE 5\n";
    start("k.c", mine + drawn(false, "") + drawn_in(false), "k.cpp", drawn(false, "") + drawn_in(false));
    const std::string run = replaced(replaced(drawn_in(true), "int rounds = 3", "int rounds = 3 + MINE"),
                                     "return rounds", "return rounds + 1"),
                      draw = replaced(replaced(drawn(true, ""), "fill(a, n)", "fill(a, n + MINE)"), "clock_now()",
                                      "clock_now(MINE)");
    const nlohmann::json got = proposals_of(mine + draw + run);
    EXPECT_EQ(got[0]["state"], "refused") << got.dump(1);
    EXPECT_EQ(got[1]["state"], "partial") << got.dump(1);
    EXPECT_EQ(got[1]["patch"].dump().find("double all"), std::string::npos) << got.dump(1);
    EXPECT_NE(got[1]["patch"].dump().find("rounds + 1"), std::string::npos) << got.dump(1);
}

TEST_F(SyncWhole, AValueIsNotGivenBackByABlockThatIsHandedOver) {
    start("k.c", drawn(false, ""), "k.cpp",
          "void draw(float* a, int n) {\n  each(n, [=](int i) {\n    a[i] = 0;\n  });\n}\n");
    const nlohmann::json got = proposal_of(drawn(true, ""));
    EXPECT_NE(got["state"], "proposed") << got.dump(1);
}

TEST_F(SyncWhole, WhatQualifiesAPointerComesBehindOne) {
    start("k.cu", "__global__ void fade(float* a, float* b, int n) {\n  a[n] = b[n] * 2.0f;\n}\n", "k.cpp",
          "void fade(float* a, int b, int n) {\n  a[n] = table(b)[n] * 2.0f;\n}\n");
    const std::string now =
        "__global__ void fade(float* __restrict__ a, float* __restrict__ b, int n) {\n  a[n] = b[n] * 3.0f;\n}\n";
    write(source_path, now);
    for (const nlohmann::json& one : proposals_of(now))
        if (one["patch"].is_string()) {
            EXPECT_EQ(one["patch"].get<std::string>().find("int __restrict__"), std::string::npos) << one.dump(1);
        }
}

std::string timed(const std::string& within, const std::string& behind) {
    return "int run(float* a, int n) {\n  double start = 0;\n  if (n > 0) {\n    start = seconds();\n    work(a, "
           "n);\n" +
           within + "  }\n" + behind + "  return n;\n}\n";
}

TEST_F(SyncWhole, ABlockThatEndsElsewhereEndsThereOnBothSides) {
    start("k.c", timed("", "  tell(seconds() - start);\n"), "k.cpp", timed("", "  tell(seconds() - start);\n"));
    expect_ported(timed("    tell(seconds() - start);\n", ""), timed("    tell(seconds() - start);\n", ""));
}

TEST_F(SyncWhole, AnEndWithoutItsOtherEndIsLeftAndTheRestIsWritten) {
    const std::string port =
        "int run(float* a, int n) {\n  double start = 0;\n  {\n    Buffer all(a, n);\n    start = seconds();\n"
        "    submit(all, [=](int i) {\n      work(a, i);\n    });\n  }\n  first(a);\n  second(a);\n"
        "  tell(seconds() - start);\n  return n;\n}\n";
    const std::string source =
        "int run(float* a, int n) {\n  double start = 0;\n  {\n    start = seconds();\n    work(a, n);\n  }\n"
        "  first(a);\n  second(a);\n  tell(seconds() - start);\n  return n;\n}\n";
    start("k.c", source, "k.cpp", port);
    std::string now = replaced(source, "  }\n  first(a);\n  second(a);\n  tell(seconds() - start);\n",
                               "    tell(seconds() - start);\n  }\n  first(a);\n  second(a);\n");
    const nlohmann::json got = proposal_of(replaced(now, "return n;", "return n + 1;"));
    EXPECT_EQ(got.dump().find("could not be read back"), std::string::npos) << got.dump(1);
}

}  // namespace sync_whole_test
}  // namespace porttool::testing
