// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Names that no file of either side declares, in edits of files that git has as they were. Each port is as a person
// would write it.
#include "tests/porttool/synced_repository.h"

namespace porttool::testing {
namespace sync_elsewhere_test {

class SyncElsewhere : public SyncedRepository {};

const std::string kPool =
    "void Pool::forward_cpu(Blob* top) {\n"
    "  const float* data = top->cpu_data();\n"
    "  float* out = top->mutable_cpu_data();\n"
    "  scale_cpu(count_, data, out);\n"
    "  clear_cpu(count_, out);\n"
    "}\n";
const std::string kPoolPort =
    "void Pool::forward_gpu(Blob* top) {\n"
    "  const float* data = top->gpu_data();\n"
    "  float* out = top->mutable_gpu_data();\n"
    "  scale_gpu(count_, data, out);\n"
    "  clear_gpu(count_, out);\n"
    "}\n";

TEST_F(SyncElsewhere, AFieldOfTheClassIsKnownToBothItsMethods) {
    start("pool.cpp", kPool, "pool.cu", kPoolPort);
    expect_ported(replaced(kPool, "  clear_cpu", "  if (!is_idle_) clear_cpu"),
                  replaced(kPoolPort, "  clear_gpu", "  if (!is_idle_) clear_gpu"));
}

TEST_F(SyncElsewhere, ANameHasThePartThatThePortsNamesHave) {
    start("pool.cpp", kPool, "pool.cu", kPoolPort);
    expect_ported(
        replaced(kPool, "  clear_cpu(count_, out);\n", "  clear_cpu(count_, out);\n  round_cpu(count_, out);\n"),
        replaced(kPoolPort, "  clear_gpu(count_, out);\n", "  clear_gpu(count_, out);\n  round_gpu(count_, out);\n"));
}

const std::string kClip =
    "float clip(float v, float top) {\n  float r = v * FACTOR;\n  if (r > top) r = top;\n  return r;\n}\n";
const std::string kClipPort =
    "float clip(float v, float top) {\n  float r = v;\n  if (r > top) r = top;\n  return r;\n}\n";

TEST_F(SyncElsewhere, ANameThatIsNewToTheSourcesFileIsNewToThePortAsWell) {
    start("clip.cu", kClip, "clip.cpp", kClipPort);
    expect_ported(replaced(kClip, "r > top", "r > top + kSlack"), replaced(kClipPort, "r > top", "r > top + kSlack"));
}

TEST_F(SyncElsewhere, ANameThatTheSourceHadBeforeMayBeItsOwn) {
    start("clip.cu", kClip, "clip.cpp", kClipPort);
    expect_left(replaced(kClip, "r > top", "r > top * FACTOR"), "`FACTOR`", 3);
}

const std::string kWarmClip = replaced(kClipPort, "{\n", "{\n  warm_up(FACTOR);\n");

TEST_F(SyncElsewhere, WhatThePortHasNothingLikeIsLeftPerhapsBesideWhatIsSure) {
    start("clip.cu", kWarmClip, "clip.cpp", kClipPort);
    const nlohmann::json got = proposal_of(replaced(kClipPort, "r > top", "r > top * FACTOR"));
    EXPECT_EQ(got["state"], "refused") << got.dump(1);
    ASSERT_EQ(got["left"].size(), 1) << got.dump(1);
    EXPECT_NE(got["left"][0]["message"].get<std::string>().find("`FACTOR`"), std::string::npos) << got.dump(1);
    ASSERT_EQ(got["why"].size(), 1) << got.dump(1);
    const auto why = got["why"][0].get<std::string>();
    EXPECT_TRUE(why.starts_with("perhaps, source line ")) << why;
    EXPECT_NE(why.find("warm_up"), std::string::npos) << why;
    EXPECT_NE(porttool({"sync"}).out.find("    perhaps for you, source line "), std::string::npos);
}

TEST_F(SyncElsewhere, WhatThePortHasNothingLikeIsLeftWhereNothingElseIs) {
    start("clip.cu", kWarmClip, "clip.cpp", kClipPort);
    const nlohmann::json got = proposal_of(kClipPort);
    EXPECT_EQ(got["state"], "refused") << got.dump(1);
    ASSERT_EQ(got["left"].size(), 1) << got.dump(1);
    EXPECT_NE(got["left"][0]["message"].get<std::string>().find("warm_up"), std::string::npos) << got.dump(1);
}

TEST_F(SyncElsewhere, WhatThePortHasInOtherWordsIsLeftForSure) {
    const std::string warm = "  submit(queue, first_device, kernels::warm_up, grid_of(top), block_of(top), nullptr);\n";
    start("clip.cu", kWarmClip, "clip.cpp", replaced(kClipPort, "{\n", "{\n" + warm));
    const nlohmann::json got = proposal_of(replaced(kClipPort, "r > top", "r > top * FACTOR"));
    EXPECT_EQ(got["state"], "refused") << got.dump(1);
    EXPECT_EQ(got["left"].size(), 2) << got.dump(1);
    EXPECT_TRUE(got["why"].empty()) << got.dump(1);
}

TEST_F(SyncElsewhere, ATextThatSpeaksOfTheSourcesPlatformIsLeft) {
    const std::string host = "void begin(int n) {\n  prepare(n);\n  launch(n);\n}\n";
    start("begin.cu", host, "begin.cpp", host);
    const nlohmann::json got = proposal_of(replaced(host, "launch(n)", "say(\"the CUDA part begins\");\n  launch(n)"));
    EXPECT_EQ(got["state"], "refused") << got.dump(1);
    const std::string plain = replaced(host, "launch(n)", "say(\"it begins\");\n  launch(n)");
    expect_ported(plain, plain);
}

TEST_F(SyncElsewhere, AFieldLosesThePrefixThatThePortsFieldsLack) {
    const std::string source =
        "void Core::render(int mode) {\n  if (mode == Restart) m_SamplesTaken = 0;\n  m_FrameCount = m_FrameCount + "
        "1;\n"
        "}\n";
    const std::string port =
        "void Core::render(int mode) {\n  if (mode == Restart) samplesTaken = 0;\n  frameCount = frameCount + 1;\n}\n";
    start("core.cpp", source, "core.cu", port);
    const nlohmann::json got = proposal_of(replaced(source, "mode == Restart", "mode == Restart || m_FirstFrame"));
    EXPECT_EQ(got["state"], "partial") << "check knows nothing of it: " << got.dump(1);
    EXPECT_NE(got["patch"].get<std::string>().find("|| firstFrame)"), std::string::npos) << got.dump(1);
}

TEST_F(SyncElsewhere, BracesGoBeforeAnElseAsWell) {
    const std::string braced =
        "int pick(int v) {\n  if (v > 2) {\n    v = 2;\n  } else if (v > 1) {\n    v = 1;\n  }\n  return v;\n}\n";
    const std::string bare =
        "int pick(int v) {\n  if (v > 3)\n    v = 3;\n  else if (v > 1)\n    v = 1;\n  return v;\n}\n";
    start("pick.cpp", braced, "pick.cu", braced);
    write(source_path, bare);
    ASSERT_EQ(porttool({"sync", "--apply"}).exit_code, 0);
    EXPECT_EQ(port_now().find("{\n    v"), std::string::npos) << port_now();
}

TEST_F(SyncElsewhere, AVariableThatIsDeclaredFurtherDownIsNotUsedAboveThat) {
    const std::string source =
        "__kernel void embed(int dim, int j, __global float* out) {\n  int n = dim / 2;\n  if (j == (dim + 1) / 2) {\n"
        "    out[dim] = 0.0f;\n  }\n  if (j >= n) return;\n  out[j] = 1.0f;\n}\n";
    const std::string port =
        "__global__ void embed(int dim, int j, float* out) {\n  if (j == (dim + 1) / 2) {\n    out[dim] = 0.0f;\n  }\n"
        "  int half = dim / 2;\n  if (j >= half) return;\n  out[j] = 1.0f;\n}\n";
    start("embed.cl", source, "embed.cu", port);
    const nlohmann::json got = proposal_of(replaced(source, "j == (dim + 1) / 2", "j == n"));
    EXPECT_NE(got["state"], "proposed") << got.dump(1);
}

TEST_F(SyncElsewhere, ACounterIsKnownFromACallThatBothSidesHave) {
    const std::string source =
        "__kernel void hash(int count, __global int* out) {\n  for (int pos = 0; pos < count; pos++) {\n"
        "    int v = mix(pos);\n    if (v == 3) {\n      mark(out, v, pos, 0);\n    }\n  }\n}\n";
    const std::string port =
        "__kernel void hash(int count, __global int* out) {\n  for (int pos = 0; pos < count; pos += WIDTH) {\n"
        "    int v = mix(pos);\n    if (v == 3) {\n      mark(out, v, pos, 0);\n    }\n  }\n}\n";
    const std::string more = "    }\n    if (v == 5) {\n      mark(out, v, pos, 0);\n    }\n  }\n}\n";
    start("hash.cl", source, "wide.cl", port);
    expect_ported(replaced(source, "    }\n  }\n}\n", more), replaced(port, "    }\n  }\n}\n", more));
}

TEST_F(SyncElsewhere, AValueChangesInADeclarationOfSeveral) {
    const std::string source =
        "int worst(const float* e, int n) {\n  float most = 0.0f;\n  size_t count = n;\n"
        "  for (int i = 0; i < n; i++) most = fmax(most, e[i]);\n  return report(count, most);\n}\n";
    const std::string port =
        "int worst(const float* e, int n) {\n  float d, other, most = 0.0f;\n  size_t count = n;\n"
        "  for (int i = 0; i < n; i++) { d = e[i]; most = fmax(most, d); }\n  return report(count, most);\n}\n";
    start("worst.c", source, "worst.cpp", port);
    expect_ported(replaced(source, "most = 0.0f", "most = -100.0f"), replaced(port, "most = 0.0f", "most = -100.0f"));
}

TEST_F(SyncElsewhere, StatementsThatAreLostSideBySideAreOneItemBesideWhatIsLikeThem) {
    const std::string source =
        "int sum(int n) {\n  begin();\n  int a = first(n);\n  int b = second(n);\n  int c = third(n);\n  end(n);\n"
        "  return n;\n}\n";
    const std::string port =
        "int sum(int n) {\n  begin();\n  own(n);\n  all_of_them(first, second, third);\n  end(n);\n  return n;\n}\n";
    start("sum.cpp", source, "sum.cu", port);
    const nlohmann::json got =
        proposal_of(replaced(source, "  int a = first(n);\n  int b = second(n);\n  int c = third(n);\n", ""));
    ASSERT_EQ(got["left"].size(), 2u) << "what `own` may stand for, and the other two: " << got.dump(1);
    EXPECT_NE(got["left"][1]["message"].get<std::string>().find("int b = second ( n ) ; int c"), std::string::npos);
    EXPECT_EQ(got["left"][1]["target_line"], 4) << got.dump(1);
}

TEST_F(SyncElsewhere, NamesOfAStructuredBindingAreDeclared) {
    const std::string source = "int parse(Args args) {\n  auto parsed = list(args);\n  return take(parsed.file);\n}\n";
    start("parse.cpp", source, "parse.cu", source);
    const std::string now = replaced(replaced(source, "auto parsed", "auto [rest, parsed]"), "parsed.file", "parsed");
    const nlohmann::json got = proposal_of(now);
    EXPECT_EQ(got["state"], "proposed") << got.dump(1);
}

}  // namespace sync_elsewhere_test
}  // namespace porttool::testing
