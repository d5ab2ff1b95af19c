// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What sync proposes, against ports that were written by hand: each test has the port as a person would make it.
#include <array>

#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing {
namespace {

/// A text without white space, which is a port's own affair.
std::string dense(const std::string& text) {
    std::string out;
    for (const char c : text)
        if (c != ' ' && c != '\t' && c != '\n' && c != '\r') out += c;
    return out;
}

struct EditCase {
    std::string source = "k.cu", target = "k.glsl";  ///< names of the files
    std::string before, after;                       ///< of the source
    std::string port, ported;                        ///< as it is, and as a person would leave it
};

/// What sync made of an edit.
struct Synced {
    nlohmann::json proposal;
    int exit_code = 0;
    std::string port;  ///< after --apply
    std::string state() const { return proposal["state"]; }
    std::string why() const { return proposal.dump(1); }
};

Synced synced(const EditCase& one) {
    MemoryDisk disk;
    const std::string source = "/r/src/" + one.source, target = "/r/port/" + one.target;
    disk.files = {{source, one.before}, {target, one.port}};
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    disk.files[source] = one.after;
    const CommandRun got = run(disk, {"-C", "/r", "sync", "--format", "json"});
    EXPECT_NE(got.exit_code, 2) << got.err;
    Synced out;
    out.exit_code = got.exit_code;
    if (got.exit_code == 2) return out;
    const nlohmann::json all = nlohmann::json::parse(got.out);
    EXPECT_LE(all["proposals"].size(), 1u);
    out.proposal = all["proposals"].empty()
                       ? nlohmann::json{{"state", "already"}, {"patch", nullptr}, {"left", nlohmann::json::array()}}
                       : all["proposals"][0];
    EXPECT_EQ(disk.files[target], one.port) << "without --apply nothing is written";
    run(disk, {"-C", "/r", "sync", "--apply", "--force"});
    out.port = disk.files[target];
    const bool whole = out.state() == "proposed";
    EXPECT_EQ(whole || out.state() == "partial", out.proposal["patch"].is_string()) << out.why();
    EXPECT_EQ(out.state() == "partial" || out.state() == "refused", !out.proposal["left"].empty()) << out.why();
    EXPECT_EQ(out.exit_code, out.proposal["left"].empty() ? 0 : 1);
    if (whole) {
        EXPECT_EQ(run(disk, {"-C", "/r", "check", "--strict"}).exit_code, 0) << out.port;
    } else {
        EXPECT_EQ(out.port, one.port) << "only what is proposed is written";
    }
    return out;
}

/// The port must be proposed, word for word.
void expect_ported(const EditCase& one) {
    const Synced got = synced(one);
    EXPECT_EQ(got.state(), "proposed") << got.why();
    EXPECT_EQ(dense(got.port), dense(one.ported)) << got.port;
}

/// The port must be proposed, white space and all.
void expect_written(const EditCase& one) {
    const Synced got = synced(one);
    EXPECT_EQ(got.state(), "proposed") << got.why();
    EXPECT_EQ(got.port, one.ported);
}

/// Another text than the hand-made one must not be proposed.
void expect_not_wrong(const EditCase& one) {
    const Synced got = synced(one);
    if (got.state() == "proposed") {
        EXPECT_EQ(dense(got.port), dense(one.ported)) << got.port;
    }
}

/// A person has to see to it.
void expect_left(const EditCase& one) {
    const Synced got = synced(one);
    EXPECT_TRUE(got.state() == "refused" || got.state() == "partial") << got.why() << got.port;
}

const std::string kWeighSource =
    "__device__ float weigh(const Hit* hit, float scale, int count) {\n"
    "    float sum = 0.0f;\n"
    "    for (int i = 0; i < count; i++) {\n"
    "        sum += hit->t * scale;\n"
    "    }\n"
    "    if (sum > 1.0f) sum = 1.0f;\n"
    "    float gain = sqrtf(sum);\n"
    "    return gain * 0.5f;\n"
    "}\n";
const std::string kWeighPort =
    "float weigh(in Hit hit, float scale, int count)\n"
    "{\n"
    "  float total = 0.0;\n"
    "  for (int i = 0; i < count; i++)\n"
    "  {\n"
    "    total += hit.t * scale;\n"
    "  }\n"
    "  if (total > 1.0) total = 1.0;\n"
    "  float gain = sqrt(total);\n"
    "  return gain * 0.5;\n"
    "}\n";

/// An edit of that kernel, with what it makes of the port.
EditCase weighed(const std::string& from, const std::string& to, const std::string& there, const std::string& becomes) {
    return {"k.cu",       "k.glsl",
            kWeighSource, replaced(kWeighSource, from, to),
            kWeighPort,   replaced(kWeighPort, there, becomes)};
}

TEST(SyncEdit, AConstantChanges) {
    expect_ported(weighed("gain * 0.5f", "gain * 0.25f", "gain * 0.5", "gain * 0.25"));
    expect_ported(weighed("sum > 1.0f", "sum > 2.0f", "total > 1.0", "total > 2.0"));
}

/// Host code of two of C's family, of which nobody else has said a word.
EditCase hosted(const std::string& target, const std::string& gained) {
    const std::string kernel = "int run(int repeat) {\n  int done = step(repeat);\n  return done;\n}\n";
    const std::string after = "int run(int repeat) {\n  int done = step(repeat);\n" + gained + "  return done;\n}\n";
    return {"k.cu", target, kernel, after, kernel, after};
}

TEST(SyncEdit, WhatALibraryOfCOrCppHasIsKnown) {
    expect_ported(hosted("k.cpp", "  struct timeval now;\n  gettimeofday(&now, NULL);\n"));
    expect_ported(hosted("k.cpp", "  if (done > RAND_MAX) exit(EXIT_FAILURE);\n"));
    expect_ported(hosted("k.cpp", "  const char* bytes = reinterpret_cast<const char*>(&done);\n  puts(bytes);\n"));
    // Of a language without that library nothing is said.
    EditCase device = hosted("k.cl", "  struct timeval now;\n  gettimeofday(&now, NULL);\n");
    expect_left(device);
}

TEST(SyncEdit, AMethodOfTheStandardLibraryIsNoVariableOfItsName) {
    const std::string other = "void other(int count) { use(count); }\n\n";
    const std::string kernel =
        "int run(int repeat) {\n  auto start = std::chrono::steady_clock::now();\n  step(repeat);\n  return 0;\n}\n";
    const std::string after = replaced(kernel, "  return 0;",
                                       "  auto end = std::chrono::steady_clock::now();\n"
                                       "  auto spent = (end - start).count();\n  return 0;");
    expect_ported({"k.cu", "k.cpp", other + kernel, other + after, kernel, after});
}

TEST(SyncEdit, AnIfdefMayAskForAMacroThatNoFileDefines) {
    const std::string shown = "#ifdef DEBUG\n  printf(\"%d\\n\", done);\n#endif\n";
    expect_ported(hosted("k.cpp", shown));
    // What only the source's file defines is not there, nor is what tells one platform.
    EditCase defined = hosted("k.cpp", shown);
    defined.before = "#define DEBUG 1\n" + defined.before;
    defined.after = "#define DEBUG 1\n" + defined.after;
    expect_left(defined);
    expect_left(hosted("k.cpp", replaced(shown, "DEBUG", "USE_CUDA")));
}

TEST(SyncEdit, HipHasTheRunTimeOfCudaUnderItsOwnNames) {
    const std::string kernel = "void run(float* d) {\n  cudaFree(d);\n}\n";
    const std::string port = "#include <hip/hip_runtime.h>\nvoid run(float* d) {\n  hipFree(d);\n}\n";
    const auto waits = [](const std::string& text, const std::string& name) {
        return replaced(text, "Free(d);", "Free(d);\n  " + name + "();");
    };
    expect_ported(
        {"k.cu", "k.cpp", kernel, waits(kernel, "cudaDeviceSynchronize"), port, waits(port, "hipDeviceSynchronize")});
    // A file that has both, or a name that is not the other's, tells nothing.
    expect_left({"k.cu", "k.cpp", kernel, waits(kernel, "cudaThreadSynchronize"), port, port});
    const std::string both = port + "void other(float* d) {\n  cudaFree(d);\n  hipFree(d);\n}\n";
    expect_not_wrong(
        {"k.cu", "k.cpp", kernel, waits(kernel, "cudaDeviceSynchronize"), both, waits(both, "cudaDeviceSynchronize")});
}

TEST(SyncEdit, AConstantPointerMayBeWrittenThrough) {
    const auto fold = [](const std::string& type, const std::string& body) {
        return "__device__ void fold(" + type + " v, int i) {\n" + body + "}\n";
    };
    const std::string was = "  v[i] = v[i] + v[i + 1];\n", is = was + "  v[i] += v[i + 2];\n";
    expect_ported({"k.cu", "k.hip", fold("float* const", was), fold("float* const", is), fold("float* const", was),
                   fold("float* const", is)});
    const std::string reads = "  use(v[i]);\n";
    expect_left({"k.cu", "k.hip", fold("float*", reads), fold("float*", reads + "  v[i] += 1.0f;\n"),
                 fold("const float*", reads), fold("const float*", reads)});
}

TEST(SyncEdit, AVariableBehindAMacroAndATypeIsTheEditsOwn) {
    const auto kernel = [](const std::string& body) {
        return "DECLSPEC u32 other(u32 S) { return S; }\n"
               "KERNEL_FQ void mix(GLOBAL_AS u32* out, u32 lid) {\n  u32 a = out[lid];\n" +
               body + "  out[lid] = a;\n}\n";
    };
    const std::string now = "  LOCAL_VK u32 S[64];\n  S[lid] = a;\n";
    expect_ported({"k.cl", "k_2.cl", kernel(""), kernel(now), kernel(""), kernel(now)});
}

TEST(SyncEdit, AnOperatorChanges) {
    expect_ported(weighed("i < count", "i <= count", "i < count", "i <= count"));
    expect_ported(weighed("gain * 0.5f", "gain / 0.5f", "gain * 0.5", "gain / 0.5"));
}

TEST(SyncEdit, AStatementComesBetweenNeighbours) {
    expect_ported(weighed("    float gain =", "    sum = sum * scale;\n    float gain =", "  float gain =",
                          "  total = total * scale;\n  float gain ="));
    expect_ported(weighed("        sum += hit->t * scale;\n", "        sum += hit->t * scale;\n        sum *= 0.5f;\n",
                          "    total += hit.t * scale;\n", "    total += hit.t * scale;\n    total *= 0.5;\n"));
}

TEST(SyncEdit, AStatementComesFirstOrLastInABlock) {
    expect_ported(weighed("        sum += hit->t", "        scale *= 0.5f;\n        sum += hit->t",
                          "    total += hit.t", "    scale *= 0.5;\n    total += hit.t"));
    expect_ported(weighed("    float sum = 0.0f;\n", "    scale = scale + 1.0f;\n    float sum = 0.0f;\n",
                          "  float total = 0.0;\n", "  scale = scale + 1.0;\n  float total = 0.0;\n"));
}

TEST(SyncEdit, AStatementGoes) {
    expect_ported(weighed("    if (sum > 1.0f) sum = 1.0f;\n", "", "  if (total > 1.0) total = 1.0;\n", ""));
    expect_ported(weighed("        sum += hit->t * scale;\n", "", "    total += hit.t * scale;\n", ""));
}

TEST(SyncEdit, ANewIfStandsAroundAStatement) {
    expect_ported(weighed("        sum += hit->t * scale;\n", "        if (scale > 0.0f) sum += hit->t * scale;\n",
                          "    total += hit.t * scale;\n", "    if (scale > 0.0) total += hit.t * scale;\n"));
    const EditCase braces =
        weighed("        sum += hit->t * scale;\n",
                "        if (scale > 0.0f) {\n            sum += hit->t * scale;\n        }\n",
                "    total += hit.t * scale;\n", "    if (scale > 0.0)\n    {\n      total += hit.t * scale;\n    }\n");
    expect_ported(braces);
}

TEST(SyncEdit, ANewIfThatLeaves) {
    expect_ported(weighed("    float gain =", "    if (sum < 0.0f) return 0.0f;\n    float gain =", "  float gain =",
                          "  if (total < 0.0) return 0.0;\n  float gain ="));
}

TEST(SyncEdit, WordsOfTheTwoLanguages) {
    const std::string other = "__device__ float other(float a, float b) { return fmaxf(a, fminf(b, 1.0f)); }\n";
    const std::string there = "float other(float a, float b) { return max(a, min(b, 1.0)); }\n";
    for (EditCase one : {weighed("gain * 0.5f", "fmaxf(gain, 0.5f)", "gain * 0.5", "max(gain, 0.5)"),
                         weighed("return gain * 0.5f", "return gain * fminf(hit->t, 1.0f)", "return gain * 0.5",
                                 "return gain * min(hit.t, 1.0)")}) {
        expect_not_wrong(one);
        for (std::string* text : {&one.before, &one.after}) *text += other;
        for (std::string* text : {&one.port, &one.ported}) *text += there;
        expect_ported(one);
    }
}

TEST(SyncEdit, ANewLocal) {
    expect_ported(weighed(
        "    float gain = sqrtf(sum);\n", "    float half_sum = sum * 0.5f;\n    float gain = sqrtf(half_sum);\n",
        "  float gain = sqrt(total);\n", "  float half_sum = total * 0.5;\n  float gain = sqrt(half_sum);\n"));
}

TEST(SyncEdit, ANewParameter) {
    expect_ported(weighed("float scale, int count) {", "float scale, float bias, int count) {",
                          "float scale, int count)", "float scale, float bias, int count)"));
    expect_ported(EditCase{
        "k.cu", "k.glsl", kWeighSource,
        replaced(replaced(kWeighSource, "int count) {", "int count, float bias) {"), "gain * 0.5f", "gain + bias"),
        kWeighPort,
        replaced(replaced(kWeighPort, "int count)", "int count, float bias)"), "gain * 0.5", "gain + bias")});
}

TEST(SyncEdit, ANewParameterOfATypeThatTheFunctionNames) {
    const std::string source =
        "Float moved(Float p, Float n) {\n    Int steps = Int(256.0f * n);\n    return p + Float(steps);\n}\n";
    const std::string edited =
        replaced(replaced(source, "Float n)", "Float n, Float scale)"), "256.0f * n", "scale * n");
    expect_ported({"k.glsl", "k.cpp", source, edited, "inline " + source, "inline " + edited});
}

// 2 is as right a step as 1 only where both sides count from the same number.
TEST(SyncEdit, AStepOfWhatCountsFromAnotherNumber) {
    const std::string head = "void f(float* out, int m) {\n    int n = ",
                      loop = ";\n    while (n < m) {\n        out[n] = 1.0f;\n        n++;\n    }\n}\n";
    const std::string two = replaced(loop, "n++", "n += 2");
    expect_ported({"k.cl", "k.cpp", head + "0" + loop, head + "0" + two, head + "0" + loop, head + "0" + two});
    expect_left({"k.cl", "k.cpp", head + "0" + loop, head + "0" + two, head + "1" + loop, ""});
}

TEST(SyncEdit, AFunctionThatWritesItsArgument) {
    const std::string take = "void take(int& n, int by) { n = n + by; }\n",
                      head = take + "float f(float* out, int m) {\n    int n = m;\n", call = "    take(n, 3);\n",
                      rest = "    out[0] = 1.0f;\n    return out[m];\n}\n", edited = replaced(rest, "1.0f", "1.0f + n");
    expect_ported(
        {"k.cu", "k.cpp", head + call + rest, head + call + edited, head + call + rest, head + call + edited});
    expect_left({"k.cu", "k.cpp", head + call + rest, head + call + edited, head + rest, ""});
    // What takes a value writes nothing.
    const std::string by_value = replaced(head, "int& n", "int n");
    expect_ported(
        {"k.cu", "k.cpp", by_value + call + rest, by_value + call + edited, by_value + rest, by_value + edited});
}

TEST(SyncLayout, WordsThatTakeThePlaceOfCloseOnesStandApartAsInTheSource) {
    const std::string text = "float f(float y, float x) {\n    float a = atan(y/x);\n    return a;\n}\n";
    const std::string edited = replaced(text, "atan(y/x)", "atan2(y, x)");
    expect_written({"k.cu", "k.cpp", text, edited, text, edited});
}

TEST(SyncEdit, AMemberIsSpelledOtherwise) {
    const EditCase one{"k.cl",
                       "k.cpp",
                       "float aim(const Aux* aux, float a) {\n    float b = aux->x * a;\n    return b + aux->y;\n}\n",
                       "float aim(const Aux* aux, float a) {\n    float b = aux->x * a;\n    b += aux->y * 2.0f;\n    "
                       "return b + aux->y;\n}\n",
                       "float aim(const Aux& aux, float a) {\n    float b = aux.x * a;\n    return b + aux.y;\n}\n",
                       "float aim(const Aux& aux, float a) {\n    float b = aux.x * a;\n    b += aux.y * 2.0f;\n    "
                       "return b + aux.y;\n}\n"};
    expect_ported(one);
}

TEST(SyncEdit, AMethodIsAFunctionOfThePort) {
    const std::string head = "float f(vec v, vec w) {\n", port_head = "float f(float4 v, float4 w) {\n";
    expect_ported({"k.cpp", "k.cl", head + "  float t = v.Dot(v);\n  return sqrt(t);\n}\n",
                   head + "  float t = w.Dot(v - w);\n  return sqrt(t);\n}\n",
                   port_head + "  float t = dot(v, v);\n  return sqrt(t);\n}\n",
                   port_head + "  float t = dot(w, v - w);\n  return sqrt(t);\n}\n"});
    expect_ported({"k.cpp", "k.cl", head + "  float t = v.Length();\n  return t;\n}\n",
                   head + "  float t = v.Length();\n  if (w[0].Length() > t) return 0;\n  return t;\n}\n",
                   port_head + "  float t = length(v);\n  return t;\n}\n",
                   port_head + "  float t = length(v);\n  if (length(w[0]) > t) return 0;\n  return t;\n}\n"});
}

TEST(SyncEdit, AFunctionIsAMethodOfThePort) {
    const std::string head = "bool f(float3 a, float3 b) {\n", port_head = "bool f(Color a, Color b) {\n";
    expect_ported({"k.cl", "k.cpp", head + "  if (Color_IsBlack(a)) return false;\n  return g(a);\n}\n",
                   head + "  if (Color_IsBlack(a) || Color_IsBlack(a * b)) return false;\n  return g(a);\n}\n",
                   port_head + "  if (a.IsBlack()) return false;\n  return g(a);\n}\n",
                   port_head + "  if (a.IsBlack() || (a * b).IsBlack()) return false;\n  return g(a);\n}\n"});
    expect_ported({"k.cl", "k.cpp", head + "  float t = dot(a, b);\n  return t > 0;\n}\n",
                   head + "  float t = dot(b, b + a);\n  return t > 0;\n}\n",
                   port_head + "  float t = a.Dot(b);\n  return t > 0;\n}\n",
                   port_head + "  float t = b.Dot(b + a);\n  return t > 0;\n}\n"});
}

TEST(SyncEdit, AWordThatTheTargetDoesNotKnowIsLeft) {
    expect_left(weighed("gain * 0.5f", "gain * source_only_table[count]", "gain * 0.5", "gain * 0.5"));
    expect_left(weighed("gain * 0.5f", "source_only_call(gain)", "gain * 0.5", "gain * 0.5"));
    const Synced left = synced(weighed("gain * 0.5f", "source_only_call(gain)", "gain * 0.5", "gain * 0.5"));
    ASSERT_FALSE(left.proposal["left"].empty());
    const auto& item = left.proposal["left"][0];
    EXPECT_NEAR(item["source_line"].get<int>(), 8, 3) << item;
    EXPECT_NEAR(item["target_line"].get<int>(), 10, 3) << item;
    EXPECT_NE(item["message"].get<std::string>().find("source_only_call"), std::string::npos) << item;
}

TEST(SyncEdit, ThePortHasItAlready) {
    // It went ahead: the source catches up with a port that was recorded with the statement.
    EditCase one = weighed("    float gain =", "    sum = sum * scale;\n    float gain =", "  float gain =",
                           "  total = total * scale;\n  float gain =");
    one.port = one.ported;
    const Synced got = synced(one);
    EXPECT_EQ(got.state(), "already") << got.why();
    EXPECT_EQ(got.port, one.port);
    EditCase constant = weighed("gain * 0.5f", "gain * 0.25f", "gain * 0.5", "gain * 0.25");
    constant.port = constant.ported;
    EXPECT_EQ(synced(constant).state(), "already");
}

TEST(SyncEdit, AnEditThatChangesNothingIsNotDue) {
    for (const EditCase& one : {weighed("    float gain =", "    // root\n    float gain =", "gain", "gain"),
                                weighed("    float gain =", "    const float gain =", "gain", "gain"),
                                weighed("i++", "++i", "gain", "gain")}) {
        const Synced got = synced({one.source, one.target, one.before, one.after, kWeighPort, kWeighPort});
        EXPECT_EQ(got.state(), "already") << got.why();
        EXPECT_EQ(got.port, kWeighPort);
    }
}

TEST(SyncEdit, TwoLinesThatAreAlikeAreNotMixedUp) {
    const std::string twice =
        "__device__ float both(float a, float b) {\n    float c = a * 2.0f;\n    c = c + b;\n    a = a + 1.0f;\n    c "
        "= c + b;\n    return c * a;\n}\n";
    const std::string port =
        "float both(float a, float b) {\n    float c = a * 2.0;\n    c = c + b;\n    a = a + 1.0;\n    c = c + b;\n    "
        "return c * a;\n}\n";
    const std::string second = "    a = a + 1.0f;\n    c = c + b;\n", there = "    a = a + 1.0;\n    c = c + b;\n";
    expect_ported({"k.cu", "k.glsl", twice, replaced(twice, second, "    a = a + 1.0f;\n    c = c - b;\n"), port,
                   replaced(port, there, "    a = a + 1.0;\n    c = c - b;\n")});
    expect_ported({"k.cu", "k.glsl", twice, replaced(twice, second, "    a = a + 1.0f;\n"), port,
                   replaced(port, there, "    a = a + 1.0;\n")});
}

TEST(SyncEdit, ABareNumberInThePortIsNotGuessed) {
    const std::string source =
        "int pick(int kind, int a) {\n    if (kind == KIND_FLAT) return a;\n    return a + 1;\n}\n";
    const std::string port = "int pick(int kind, int a) {\n    if (kind == 3) return a;\n    return a + 1;\n}\n";
    expect_left({"k.c", "k.cpp", source, replaced(source, "KIND_FLAT", "KIND_ROUND"), port, port});
}

TEST(SyncEdit, AnInvertedBranchIsNotWidenedWrongly) {
    const std::string source =
        "float cut(float a, float b) {\n    if (a > b) {\n        a = b;\n    }\n    return a;\n}\n";
    const std::string port =
        "float cut(float a, float b) {\n    if (!(a > b)) return a;\n    a = b;\n    return a;\n}\n";
    expect_not_wrong({"k.c", "k.cpp", source,
                      replaced(source, "        a = b;\n", "        a = b;\n        b = 0.0f;\n"), port,
                      replaced(port, "    a = b;\n", "    a = b;\n    b = 0.0f;\n")});
}

TEST(SyncEdit, AVectorStatementThatIsAChannelLoopIsNotGuessed) {
    const std::string source = "float4 tint(float4 a, float b) {\n    float4 c = a * b;\n    return c;\n}\n";
    const std::string port =
        "void tint(const float* a, float b, float* c) {\n    for (int k = 0; k < 4; k++) c[k] = a[k] * b;\n}\n";
    expect_not_wrong({"k.cl", "k.cpp", source, replaced(source, "a * b", "a * b + b"), port,
                      replaced(port, "a[k] * b", "a[k] * b + b")});
}

TEST(SyncEdit, TheOriginalFollowsThePortWhereThatIsAsked) {
    MemoryDisk disk = started(kWeighSource, kWeighPort);
    disk.files["/r/port/k.comp"] = replaced(kWeighPort, "gain * 0.5", "gain * 0.25");
    EXPECT_EQ(run(disk, {"-C", "/r", "sync", "--apply", "--force", "--to", "source"}).exit_code, 0);
    EXPECT_EQ(disk.files["/r/src/k.cu"], replaced(kWeighSource, "gain * 0.5f", "gain * 0.25f"));
}

TEST(SyncEdit, BothSidesEdited) {
    // Elsewhere: what the port did stays, what the source did comes.
    MemoryDisk disk = started(kWeighSource, kWeighPort);
    const std::string port = replaced(kWeighPort, "total > 1.0", "total > 4.0");
    disk.files["/r/src/k.cu"] = replaced(kWeighSource, "gain * 0.5f", "gain * 0.25f");
    disk.files["/r/port/k.comp"] = port;
    const CommandRun got = run(disk, {"-C", "/r", "sync", "--format", "json"});
    ASSERT_NE(got.exit_code, 2) << got.err;
    const nlohmann::json one = nlohmann::json::parse(got.out)["proposals"][0];
    if (one["patch"].is_string()) {
        EXPECT_NE(one["patch"].get<std::string>().find("+  return gain * 0.25;"), std::string::npos) << one;
    }
    run(disk, {"-C", "/r", "sync", "--apply", "--force", "--partial"});
    EXPECT_NE(disk.files["/r/port/k.comp"].find("total > 4.0"), std::string::npos) << "a person's edit is kept";
    // In one place: nobody knows which is right.
    disk.files["/r/port/k.comp"] = replaced(kWeighPort, "gain * 0.5", "gain * 0.125");
    const CommandRun other = run(disk, {"-C", "/r", "sync", "--format", "json"});
    EXPECT_EQ(other.exit_code, 1) << other.out;
    EXPECT_NE(nlohmann::json::parse(other.out)["proposals"][0]["state"], "proposed");
}

/// The bytes of the port after an edit of a constant, with every line end of both sides written so.
std::string ported_bytes(const std::string& source, const std::string& port) {
    MemoryDisk disk = started(source, port);
    disk.files["/r/src/k.cu"] = replaced(source, "sum > 1.0f", "sum > 2.0f");
    disk.files["/r/src/k.cu"] = replaced(disk.files["/r/src/k.cu"], "return gain", "sum = 0.0f; return gain");
    EXPECT_EQ(run(disk, {"-C", "/r", "sync", "--apply", "--force"}).exit_code, 0);
    return disk.files["/r/port/k.comp"];
}

std::string with_ends(const std::string& text, const std::string& end) {
    std::string out;
    for (const char c : text) out += c == '\n' ? end : std::string(1, c);
    return out;
}

TEST(SyncEdit, LineEndsAndTabsStay) {
    const std::string plain = ported_bytes(kWeighSource, kWeighPort);
    EXPECT_EQ(dense(plain), dense(replaced(replaced(kWeighPort, "total > 1.0", "total > 2.0"), "return gain",
                                           "total = 0.0; return gain")));
    EXPECT_EQ(ported_bytes(kWeighSource, with_ends(kWeighPort, "\r\n")), with_ends(plain, "\r\n"));
    EXPECT_EQ(ported_bytes(with_ends(kWeighSource, "\r\n"), kWeighPort), plain);
    std::string tabs;
    for (size_t i = 0; i < kWeighPort.size(); ++i) {
        if (kWeighPort.compare(i, 2, "  ") == 0)
            tabs += '\t', ++i;
        else
            tabs += kWeighPort[i];
    }
    const std::string tabbed = ported_bytes(kWeighSource, tabs);
    EXPECT_EQ(tabbed.find("  "), std::string::npos) << tabbed;
    EXPECT_EQ(dense(tabbed), dense(plain));
}

TEST(SyncEdit, AFileWithoutANewlineAtItsEnd) {
    const std::string source = "__device__ float f(float a) { return a * 2.0f; }",
                      port = "float f(float a) { return a * 2.0; }";
    MemoryDisk disk = started(source, port);
    disk.files["/r/src/k.cu"] = replaced(source, "2.0f", "3.0f");
    const CommandRun got = run(disk, {"-C", "/r", "sync", "--format", "patch"});
    EXPECT_NE(got.out.find("-" + port + "\n\\ No newline at end of file\n"), std::string::npos) << got.out;
    EXPECT_EQ(run(disk, {"-C", "/r", "sync", "--apply", "--force"}).exit_code, 0);
    EXPECT_EQ(disk.files["/r/port/k.comp"], replaced(port, "2.0", "3.0"));
}

TEST(SyncEdit, BytesThatAreNoUtf8StayInThePatch) {
    const std::string source = "__device__ float f(float a) { return a * 2.0f; }\n";
    const std::string port = "// M\xFCller\nfloat f(float a) { return a * 2.0; }\n";
    MemoryDisk disk = started(source, port);
    disk.files["/r/src/k.cu"] = replaced(source, "2.0f", "3.0f");
    const CommandRun got = run(disk, {"-C", "/r", "sync", "--format", "patch"});
    EXPECT_NE(got.out.find(" // M\xFCller\n"), std::string::npos) << got.out;
}

TEST(SyncEdit, AFunctionThatIsTooLong) {
    std::string body;
    for (int i = 0; i < 1300; ++i) body += "    a = a + " + std::to_string(i) + ";\n";
    const std::string text = "int f(int a) {\n" + body + "    return a;\n}\n";
    const Synced got = synced({"k.c", "k.cpp", text, replaced(text, "return a;", "return a + 1;"), text, text});
    EXPECT_EQ(got.state(), "refused") << got.why();
    EXPECT_NE(got.why().find("5000"), std::string::npos) << got.why();
}

TEST(SyncEdit, TheTextBeforeIsGone) {
    MemoryDisk disk = started(kWeighSource, kWeighPort);
    disk.files["/r/src/k.cu"] = replaced(kWeighSource, "gain * 0.5f", "gain * 0.25f");
    for (auto file = disk.files.begin(); file != disk.files.end();)
        file = file->first.starts_with("/r/portmap.base/") ? disk.files.erase(file) : std::next(file);
    const CommandRun got = run(disk, {"-C", "/r", "sync", "--format", "json"});
    EXPECT_EQ(got.exit_code, 1);
    const nlohmann::json one = nlohmann::json::parse(got.out)["proposals"][0];
    EXPECT_EQ(one["state"], "refused");
    EXPECT_NE(one["left"][0]["message"].get<std::string>().find("portmap.base"), std::string::npos);
}

TEST(SyncEdit, OtherUnitsOfTheFileStay) {
    const std::string more = "\n__device__ float other(float a) {\n    return a * 0.5f;\n}\n";
    const std::string there = "\nfloat other(float a)\n{\n  return a * 0.5; // half\n}\n";
    const Synced got = synced({"k.cu", "k.glsl", kWeighSource + more,
                               replaced(kWeighSource, "gain * 0.5f", "gain * 0.25f") + more, kWeighPort + there, ""});
    EXPECT_EQ(got.state(), "proposed") << got.why();
    EXPECT_EQ(got.port, replaced(kWeighPort, "gain * 0.5", "gain * 0.25") + there);
}

TEST(SyncEdit, CommentsOfThePortStay) {
    const std::string noted =
        replaced(kWeighPort, "  return gain * 0.5;", "  // half of it\n  return gain * 0.5; // PORT: no macro");
    EditCase one = weighed("gain * 0.5f", "gain * 0.25f", "gain", "gain");
    one.port = noted;
    const Synced got = synced(one);
    EXPECT_EQ(got.state(), "proposed") << got.why();
    EXPECT_EQ(got.port, replaced(noted, "gain * 0.5", "gain * 0.25"));
}

/// An edit of `shade` in OpenCL, whose port to C++ is another text.
EditCase shaded(const std::string& before, const std::string& from, const std::string& to, const std::string& port,
                const std::string& there = "", const std::string& becomes = "") {
    return {"k.cl", "k.cpp",
            before, replaced(before, from, to),
            port,   there.empty() ? port : replaced(port, there, becomes)};
}

TEST(SyncEdit, ABranchThatThePortHasTheOtherWayRound) {
    const std::string source =
        "float shade(float a, float b, float c) {\n    if (a > b) {\n        c = b;\n    } else {\n        c = a;\n    "
        "}\n"
        "    return a + b + c;\n}\n";
    const std::string port =
        "float shade(float a, float b, float c) {\n    if (a <= b) {\n        c = a;\n    } else {\n        c = b;\n   "
        " }\n"
        "    return a + b + c;\n}\n";
    expect_not_wrong(shaded(source, "        c = b;\n", "        c = b;\n        b = 1.0f;\n", port, "        c = b;\n",
                            "        c = b;\n        b = 1.0f;\n"));
    expect_not_wrong(shaded(source, "a > b", "a > b && c > 0.0f", port, "a <= b", "a <= b || c <= 0.0f"));
    const std::string guarded =
        "float shade(float a, float b) {\n    if (a > b) {\n        a = b * 3.0f;\n        b = a;\n    }\n    return "
        "a;\n}\n";
    const std::string leaves =
        "float shade(float a, float b) {\n    if (a <= b) return a;\n    a = b * 3.0f;\n    b = a;\n    return a;\n}\n";
    expect_not_wrong(shaded(guarded, "a > b", "a > b && b > 0.0f", leaves, "a <= b", "a <= b || b <= 0.0f"));
}

TEST(SyncEdit, AStatementThatMovedKeepsItsNumbers) {
    const std::string text =
        "float shade(float a, float b) {\n    float c = a * 2.0f;\n    float d = b * 3.0f;\n    return c + d;\n}\n";
    const std::string before = "    float c = a * 2.0f;\n    float d = b * 3.0f;\n",
                      now = "    float d = b * 3.0f;\n    float c = a * 2.0f;\n";
    expect_ported(shaded(text, before, now, text, before, now));
}

TEST(SyncEdit, AnIndexThatThePortWritesOtherwise) {
    expect_not_wrong(shaded("float shade(const float* m, int i, int j, int w) {\n    return m[i * w + j];\n}\n",
                            "m[i * w + j]", "m[i * w + j] + m[(i + 1) * w + j]",
                            "float shade(const float m[4][4], int i, int j, int w) {\n    return m[i][j];\n}\n",
                            "m[i][j]", "m[i][j] + m[i + 1][j]"));
}

TEST(SyncEdit, AThreadThatLeavesIsARoundOfALoop) {
    expect_not_wrong(shaded(
        "__kernel void shade(__global float* o, int n) {\n    int i = get_global_id(0);\n    if (i >= n) return;\n"
        "    o[i] = o[i] * 2.0f;\n}\n",
        "    o[i] = ", "    if (o[i] < 0.0f) return;\n    o[i] = ",
        "void shade(float* o, int n) {\n    for (int i = 0; i < n; i++) {\n        o[i] = o[i] * 2.0f;\n    }\n}\n",
        "        o[i] = ", "        if (o[i] < 0.0f) continue;\n        o[i] = "));
}

TEST(SyncEdit, ALoopThatRunsDownwards) {
    expect_not_wrong(shaded(
        "float shade(int n) {\n    float s = 0.0f;\n    for (int i = 0; i < n; ++i) s += 1.0f;\n    return s;\n}\n",
        "i < n", "i < n - 1",
        "float shade(int n) {\n    float s = 0.0f;\n    for (int i = n - 1; i >= 0; --i) s += 1.0f;\n    return "
        "s;\n}\n",
        "i = n - 1", "i = n - 2"));
}

TEST(SyncEdit, AStatementThatComesBetweenTwoThatThePortHasInOne) {
    const std::string port = "float shade(float a) {\n    float b = a, c = b;\n    return c;\n}\n";
    expect_not_wrong(shaded("float shade(float a) {\n    float b = a;\n    float c = b;\n    return c;\n}\n",
                            "    float c = b;", "    b = b * 2.0f;\n    float c = b;", port, "float b = a, c = b;",
                            "float b = a;\n    b = b * 2.0f;\n    float c = b;"));
}

TEST(SyncEdit, OneNameInTwoBlocksIsNotMixedUp) {
    const std::string source =
        "__device__ float f(float a, float b) {\n    float sum = 0.0f;\n    {\n        float v = a * 2.0f;\n"
        "        sum += v * v + v;\n        sum += v / 3.0f - v;\n        sum -= v * 5.0f + v * v * v;\n    }\n"
        "    {\n        float v = b + 1.0f;\n        sum *= v;\n    }\n    return sum;\n}\n";
    const std::string port =
        "float f(float a, float b) {\n    float sum = 0.0;\n    {\n        float p = a * 2.0;\n"
        "        sum += p * p + p;\n        sum += p / 3.0 - p;\n        sum -= p * 5.0 + p * p * p;\n    }\n"
        "    {\n        float q = b + 1.0;\n        sum *= q;\n    }\n    return sum;\n}\n";
    expect_not_wrong({"k.cu", "k.glsl", source, replaced(source, "sum *= v;", "sum *= v + 4.0f * v;"), port,
                      replaced(port, "sum *= q;", "sum *= q + 4.0 * q;")});
    expect_not_wrong({"k.cu", "k.glsl", source, replaced(source, "sum *= v;\n", "sum *= v;\n        sum += v;\n"), port,
                      replaced(port, "sum *= q;\n", "sum *= q;\n        sum += q;\n")});
}

TEST(SyncEdit, ANewLocalWhoseNameThePortHasForAnother) {
    const std::string source = "float shade(const Hit* hit) {\n    float dir = hit->t;\n    return dir;\n}\n";
    const std::string port = "float shade(const Hit& hit) {\n    float localDir = hit.t;\n    return localDir;\n}\n";
    expect_left(shaded(source, "return dir;", "float localDir = 2.0f;\n    return dir * localDir;", port));
}

TEST(SyncEdit, ACastIsWrittenAsThePortsLanguageHasIt) {
    EditCase one{
        "k.cl", "k.glsl", "float shade(int a) {\n    return 2.0f;\n}\n", "", "float shade(int a) {\n  return 2.0;\n}\n",
        ""};
    const std::array<std::array<const char*, 2>, 5> casts = {
        {{"(float)a", "float(a)"},
         {"2.0f - (float)a", "2.0 - float(a)"},
         {"(float)(a + 1)", "float(a + 1)"},
         {"(float)a * (float)(a)", "float(a) * float(a)"},
         {"(float)(a + 1) / (float)(a - 1)", "float(a + 1) / float(a - 1)"}}};
    for (const auto& [source, target] : casts) {
        one.after = replaced(one.before, "2.0f", source);
        one.ported = replaced(one.port, "2.0", target);
        expect_ported(one);
    }
    one.after = replaced(one.before, "2.0f", "(float)-a");  // what it takes is not certain
    expect_left(one);
}

TEST(SyncEdit, AWordThatThePortAlwaysQualifies) {
    const std::string source = "float shade(float a, float b) {\n    return fmin(a, 1.0f) * b;\n}\n";
    const std::string port = "float shade(float a, float b) {\n    return sycl::fmin(a, 1.0f) * b;\n}\n";
    expect_not_wrong(shaded(source, "* b", "* fmin(b, 2.0f)", port, "* b", "* sycl::fmin(b, 2.0f)"));
    expect_not_wrong(shaded(source, "* b", "* fabs(b)", port, "* b", "* sycl::fabs(b)"));
}

TEST(SyncEdit, APartialPatchTakesNothingAwayWhoseSuccessorIsLeft) {
    const EditCase one = weighed("return gain * 0.5f", "return gain * source_only_call(hit->t)", "gain", "gain");
    const Synced got = synced(one);
    if (got.proposal["patch"].is_string()) {
        EXPECT_EQ(got.proposal["patch"].get<std::string>().find("\n-  return gain"), std::string::npos) << got.why();
    }
    const Synced added =
        synced(weighed("        sum += hit->t * scale;", "        sum += source_only_call(hit->t);", "gain", "gain"));
    if (added.proposal["patch"].is_string()) {
        EXPECT_EQ(added.proposal["patch"].get<std::string>().find("\n-    total +="), std::string::npos) << added.why();
    }
}

TEST(SyncEdit, WhatGoesBeforeACallInAScope) {
    expect_ported({"k.glsl", "k.cpp", "float f(float a, float b) {\n  float root = sqrt(a);\n  return root + b;\n}\n",
                   "float f(float a, float b) {\n  float root = b * sqrt(a);\n  return root + b;\n}\n",
                   "float f(float a, float b)\n{\n    float root = std::sqrt(a);\n    return root + b;\n}\n",
                   "float f(float a, float b)\n{\n    float root = b * std::sqrt(a);\n    return root + b;\n}\n"});
}

TEST(SyncEdit, ANewLocalIsAConstantWhereThePortsAre) {
    const std::string port =
        "float f(float a, float b)\n{\n    const float x = a * b;\n    const float y = x + b;\n    const float z = y - "
        "a;\n";
    const std::string source =
        "float f(float a, float b) {\n  float x = a * b;\n  float y = x + b;\n  float z = y - a;\n";
    expect_written({"k.glsl", "k.cpp", source + "  return z;\n}\n", source + "  float w = z * x;\n  return w;\n}\n",
                    port + "    return z;\n}\n", port + "    const float w = z * x;\n    return w;\n}\n"});
}

TEST(SyncEdit, NamesOfTheStandardLibraryAreKnownInItsScope) {
    expect_ported({"k.cu", "k.cpp", "float f(float a) {\n  float b = a * 2.0f;\n  return b;\n}\n",
                   "float f(float a) {\n  float b = a * 2.0f;\n  b = std::nextafter(b, a);\n  return b;\n}\n",
                   "float f(float a) {\n  float b = a * 2.0f;\n  return b;\n}\n",
                   "float f(float a) {\n  float b = a * 2.0f;\n  b = std::nextafter(b, a);\n  return b;\n}\n"});
}

TEST(SyncEdit, ATypeOfTheLanguageIsKnownThoughNobodyUsesItThere) {
    expect_ported(
        {"k.cu", "k.hip", "__device__ float f(float a) {\n  float b = a * 2.0f;\n  return b;\n}\n",
         "__device__ float f(float a, bool twice) {\n  float b = a * 2.0f;\n  if (twice) b += a;\n  return b;\n}\n",
         "__device__ float f(float a) {\n  float b = a * 2.0f;\n  return b;\n}\n",
         "__device__ float f(float a, bool twice) {\n  float b = a * 2.0f;\n  if (twice) b += a;\n  return b;\n}\n"});
}

TEST(SyncEdit, AFunctionThatTheOtherLanguageHasBuiltIn) {
    expect_ported({"k.cpp", "k.cl", "float f(float a) {\n  float b = a * 2.0f;\n  return b;\n}\n",
                   "float f(float a) {\n  float b = a * 2.0f;\n  b *= sign(a);\n  return b;\n}\n",
                   "float f(float a) {\n  float b = a * 2.0f;\n  return b;\n}\n",
                   "float f(float a) {\n  float b = a * 2.0f;\n  b *= sign(a);\n  return b;\n}\n"});
}

TEST(SyncEdit, ALongPhraseDoesNotPartANameFromItsMember) {
    const std::string
        head = "void f(Aux &aux, float k) {\n  if (aux.i >= first && aux.i < last) {\n    k *= 2.0f;\n    aux.c = k;\n",
        port =
            "void f(Aux *aux, float k) {\n  if (aux->i >= first && aux->i < last) {\n    k *= 2.0f;\n    aux->c = k;\n";
    expect_ported({"k.cpp", "k.cl", head + "  }\n}\n", head + "    aux.c += k;\n  }\n}\n", port + "  }\n}\n",
                   port + "    aux->c += k;\n  }\n}\n"});
}

TEST(SyncEdit, AWordsOwnSpellingIsCarriedWhereThePortSaysTheSame) {
    // `cosf` and `cos` mean the same in the dialect; the port, which has the first, follows all the same.
    expect_ported({"k.cpp", "k.cu", "float f(float a) {\n  return std::cosf(a) * 2.0f;\n}\n",
                   "float f(float a) {\n  return std::cos(a) * 2.0f;\n}\n",
                   "float f(float a) {\n  return std::cosf(a) * 2.0f;\n}\n",
                   "float f(float a) {\n  return std::cos(a) * 2.0f;\n}\n"});
}

TEST(SyncEdit, ADeclarationThatThePortStillNeedsIsNotTakenAway) {
    // The source declares `norm` further out already; the port does not.
    expect_left(
        {"k.cl", "k.cpp",
         "float f(float a) {\n  float norm = 1.0f;\n  if (a > 0.0f) {\n    float norm = a * 2.0f;\n    a += norm;\n  "
         "}\n"
         "  return a;\n}\n",
         "float f(float a) {\n  float norm = 1.0f;\n  if (a > 0.0f) {\n    norm = a * 2.0f;\n    a += norm;\n  }\n"
         "  return a * norm;\n}\n",
         "float f(float a) {\n  if (a > 0.0f) {\n    float norm = a * 2.0f;\n    a += norm;\n  }\n  return a;\n}\n",
         ""});
}

TEST(SyncEdit, AVectorOfOpenClIsConstructed) {
    const std::string source = "float4 f(float4 z, float a) {\n  float4 s = (float4)(a, a, a, 0.0f);\n",
                      port = "float4 f(float4 z, float a) {\n  float4 s = float4(a, a, a, 0.0f);\n";
    expect_ported({"k.cl", "k.cpp", source + "  return z + s;\n}\n",
                   source + "  z *= (float4)(1.0f, a, a, a);\n  return z + s;\n}\n", port + "  return z + s;\n}\n",
                   port + "  z *= float4(1.0f, a, a, a);\n  return z + s;\n}\n"});
}

// Braces and lines, in the port's manner.

const std::string kPickHead = "__device__ float pick(float a, float b) {\n  float r = a;\n";
const std::string kPickPort = "float pick(float a, float b)\n{\n    float r = a;\n";

/// An edit of what lies between a head and a `return r;`.
EditCase picked(const std::string& from, const std::string& to, const std::string& there, const std::string& becomes) {
    return {"k.cu",
            "k.cpp",
            kPickHead + from + "  return r;\n}\n",
            kPickHead + to + "  return r;\n}\n",
            kPickPort + there + "    return r;\n}\n",
            kPickPort + becomes + "    return r;\n}\n"};
}

TEST(SyncLayout, ABlockOfOneStatementGetsBracesWithASecond) {
    expect_written(
        picked("  if (a > b) r = b;\n", "  if (a > b) {\n    r = b;\n    r *= 2.0f;\n  }\n",
               "    if (a > b)\n        r = b;\n    else\n        r += 1.0f;\n",
               "    if (a > b) {\n        r = b;\n        r *= 2.0f;\n    }\n    else\n        r += 1.0f;\n"));
    expect_written(picked("  if (a > b) r = b;\n", "  if (a > b) {\n    r = b;\n    r *= 2.0f;\n  }\n",
                          "    if (a > b)\n        r = b;\n    for (int i = 0; i < 3; ++i)\n    {\n        a += r;\n"
                          "        b -= r;\n    }\n",
                          "    if (a > b)\n    {\n        r = b;\n        r *= 2.0f;\n    }\n"
                          "    for (int i = 0; i < 3; ++i)\n    {\n        a += r;\n        b -= r;\n    }\n"));
}

TEST(SyncLayout, AStatementThatTakesThePlaceOfTheOnlyOneNeedsNoBraces) {
    expect_written(picked("  if (a > b) r = b;\n  r *= a;\n", "  if (a > b) a += fabsf(b) + 1.0f;\n  r *= a;\n",
                          "    if (a > b)\n        r = b;\n    r *= a;\n    r = fabsf(r);\n",
                          "    if (a > b)\n        a += fabsf(b) + 1.0f;\n    r *= a;\n    r = fabsf(r);\n"));
}

TEST(SyncLayout, AnElseThatGoesTakesItsBracesAlong) {
    expect_written(
        picked("  if (a > b) {\n    r = b;\n  } else {\n    r = a + b;\n  }\n", "  if (a > b) {\n    r = b;\n  }\n",
               "    if (a > b)\n        r = b;\n    else\n        r = a + b;\n", "    if (a > b)\n        r = b;\n"));
}

TEST(SyncLayout, AChainOfBranchesStandsInOneColumn) {
    expect_written(
        picked("  if (a > b) {\n    r = b;\n    a = r;\n  }\n",
               "  if (a > b) {\n    r = b;\n    a = r;\n  } else if (a < 0.0f) {\n    r = a;\n    b = r;\n  } else {\n"
               "    r = 1.0f;\n    b = a;\n  }\n",
               "    if (a > b)\n    {\n        r = b;\n        a = r;\n    }\n",
               "    if (a > b)\n    {\n        r = b;\n        a = r;\n    }\n    else if (a < 0.0f)\n    {\n"
               "        r = a;\n        b = r;\n    }\n    else\n    {\n        r = 1.0f;\n        b = a;\n    }\n"));
}

TEST(SyncLayout, ABlockThatGoesLeavesItsStatementsOneLevelUp) {
    expect_written(picked("  if (a > b) {\n    r = b;\n    a = r;\n  }\n", "  r = b;\n  a = r;\n",
                          "    if (a > b) {\n        r = b; // the nearer\n        a = r;\n    }\n",
                          "    r = b; // the nearer\n    a = r;\n"));
}

TEST(SyncEdit, AStatementThatMovedLeavesItsOldPlace) {
    expect_ported({"k.cpp", "k.cu",
                   "void f(Item item, float* out) {\n  out[0] = 1.0f;\n  const int i = item.get_global_id(0);\n  "
                   "out[i] = 2.0f;\n}\n",
                   "void f(Item item, float* out) {\n  const int i = item.get_global_id(0);\n  out[0] = 1.0f;\n  "
                   "out[i] = 2.0f;\n}\n",
                   "__global__ void f(float* out) {\n  out[0] = 1.0f;\n  const int i = blockDim.x * blockIdx.x + "
                   "threadIdx.x;\n  out[i] = 2.0f;\n}\n",
                   "__global__ void f(float* out) {\n  const int i = blockDim.x * blockIdx.x + threadIdx.x;\n  out[0] "
                   "= 1.0f;\n  out[i] = 2.0f;\n}\n"});
}

TEST(SyncEdit, AStatementThatBecomesAnotherIsSaidAsAWhole) {
    expect_ported({"k.cu", "k.hip",
                   "void f(int n) {\n  std::unique_ptr<char[]> text(new char[n]);\n  read(text.get(), n);\n}\n",
                   "void f(int n) {\n  auto text = std::make_unique<char[]>(n);\n  read(text.get(), n);\n}\n",
                   "void f(int n) {\n  std::unique_ptr<char[]> text(new char[n]);\n  read(text.get(), n);\n}\n",
                   "void f(int n) {\n  auto text = std::make_unique<char[]>(n);\n  read(text.get(), n);\n}\n"});
}

TEST(SyncLayout, ABlockThatBecomesAGuardLosesItsBraces) {
    expect_written(picked("  if (a < b) {\n    r = b;\n    a = r;\n  }\n",
                          "  if (a >= b) return r;\n  r = b;\n  a = r;\n",
                          "    if (a < b) {\n        r = b;\n        a = r;\n    }\n",
                          "    if (a >= b)\n        return r;\n    r = b;\n    a = r;\n"));
}

TEST(SyncLayout, ABlockWithinABranchEndsBeforeTheNextBranch) {
    const std::string from =
                          "  if (a > b) {\n    r = b;\n  } else if (b > a) {\n    for (int i = 0; i < 3; ++i) {\n      "
                          "r += a;\n    }\n  }\n",
                      to = "  if (a > b) {\n    if (b > 0.0f) {\n      r = b;\n    } else {\n      r = 0.5f;\n    }\n  "
                           "} else if (b > a) {\n    for (int i = 0; i < 3; ++i) {\n      r += a;\n    }\n  }\n";
    const std::string rest =
        "    } else if (b > a) {\n        for (int i = 0; i < 3; ++i) {\n            r += a;\n        }\n    }\n";
    expect_written(picked(from, to, "    if (a > b) {\n        r = b;\n" + rest,
                          "    if (a > b) {\n        if (b > 0.0f) {\n            r = b;\n        } else {\n           "
                          " r = 0.5f;\n        }\n" +
                              rest));
}

TEST(SyncEdit, OfALineThatGoesOnOnlyTheWordsThatChangeAreTouched) {
    const std::string rest = "use:\\n\\\n  -i output file\\n\\\n  -o output file\\n\");\n}\n";
    const std::string right = "use:\\n\\\n  -i input file\\n\\\n  -o output file\\n\");\n}\n";
    expect_ported({"k.cu", "k.cpp", "void usage() {\n  printf(\"" + rest, "void usage() {\n  printf(\"" + right,
                   "void usage()\n{\n  printf(\"" + rest, "void usage()\n{\n  printf(\"" + right});
}

TEST(SyncEdit, ABreakLeavesTheLoopThatBothSidesHave) {
    const std::string head = "__kernel void f(__global float* out, int n) {\n  int g = get_global_id(0);\n",
                      loop = "  for (int i = 0; i < n; ++i) {\n    out[g] += i;\n",
                      gained = "    if (out[g] > 9.0f) {\n      break;\n    }\n";
    const std::string port =
                          "void f(float* out, int n, int all) {\n  for (int g = 0; g < all; ++g) {\n"
                          "    for (int i = 0; i < n; ++i) {\n      out[g] += i;\n",
                      ported = "      if (out[g] > 9.0f) {\n        break;\n      }\n";
    const std::string end = "  }\n  out[g] *= 2.0f;\n}\n", there_end = "    }\n    out[g] *= 2.0f;\n  }\n}\n";
    expect_ported(
        {"k.cl", "k.cpp", head + loop + end, head + loop + gained + end, port + there_end, port + ported + there_end});
}

TEST(SyncEdit, ABreakDoesNotLeaveALoopOfThePortsOwn) {
    const std::string head =
                          "__kernel void f(__global float* out, int n) {\n  int g = get_global_id(0);\n"
                          "  for (int i = 0; i < n; ++i) {\n    out[g] += i;\n",
                      gained = "    if (out[g] > 9.0f) {\n      break;\n    }\n";
    const EditCase one{"k.cl",
                       "k.cpp",
                       head + "  }\n}\n",
                       head + gained + "  }\n}\n",
                       "void f(float* out, int n, int all) {\n  for (int i = 0; i < n; ++i) {\n"
                       "    for (int g = 0; g < all; ++g) {\n      out[g] += i;\n    }\n  }\n}\n",
                       ""};
    EXPECT_NE(synced(one).state(), "proposed");
}

TEST(SyncEdit, ANewParenthesisStandsBeforeThePathOfItsOperand) {
    const std::string here = "bool f(const Params* params, float r) {\n  const bool soft = r > 0.0f && !",
                      there = "bool f(__constant Consts* consts, float r) {\n  const bool soft = r > 0.0f && !";
    const std::string uses = ";\n  return params->far ? soft : params->shadows;\n}\n",
                      there_uses = ";\n  return consts->params.far ? soft : consts->params.shadows;\n}\n";
    expect_ported({"k.cpp", "k.cl", here + "params->shadows" + uses, here + "(params->shadows && params->far)" + uses,
                   there + "consts->params.shadows" + there_uses,
                   there + "(consts->params.shadows && consts->params.far)" + there_uses});
}

TEST(SyncEdit, AValueIsFoundInAStatementOfAnotherKind) {
    const std::string here = "vec3 curve(vec3 c) {\n  vec3 x = max(c - 0.004, vec3(0.0));\n",
                      there =
                          "float3 Curve(const float3& c) {\n  float3 out;\n  for (int k = 0; k < 3; k++) {\n"
                          "    const float x = std::max(c[k] - 0.004f, 0.0f);\n";
    expect_ported({"k.comp", "k.cpp", here + "  return (x * (6.2 * x + 0.5)) / (x * (6.2 * x + 1.7) + 0.06);\n}\n",
                   here + "  return (x * (6.2 * x + 0.5)) / (x * (6.2 * x + 1.8) + 0.05);\n}\n",
                   there + "    out[k] = (x * (6.2f * x + 0.5f)) / (x * (6.2f * x + 1.7f) + 0.06f);\n  }\n"
                           "  return out;\n}\n",
                   there + "    out[k] = (x * (6.2f * x + 0.5f)) / (x * (6.2f * x + 1.8f) + 0.05f);\n  }\n"
                           "  return out;\n}\n"});
}

TEST(SyncEdit, WhatIsDoneToTheOnlyResultIsDoneToThePorts) {
    const EditCase one{"k.comp",
                       "k.cpp",
                       "float apart(vec4 a, vec4 b) {\n  vec3 d = a.rgb - b.rgb;\n"
                       "  return dot(d, d);\n}\n",
                       "float apart(vec4 a, vec4 b) {\n  vec3 d = a.rgb - b.rgb;\n  return 0.5 * dot(d, d);\n}\n",
                       "float apart(const float* a, const float* b) {\n  float sum = 0.0f;\n"
                       "  for (int c = 0; c < 3; ++c) {\n    float d = a[c] - b[c];\n    sum += d * d;\n  }\n"
                       "  return sum;\n}\n",
                       ""};
    const Synced got = synced(one);
    EXPECT_EQ(got.state(), "partial") << "what a result is made of is not compared: a person says yes";
    EXPECT_NE(got.proposal["patch"].dump().find("+  return 0.5f * sum;"), std::string::npos) << got.why();
}

TEST(SyncEdit, AFunctionOfALibraryHasItsNewNameOnBothSides) {
    const auto here = [](const std::string& name) {
        return "#include \"kernel.h\"\nvoid run(float* a, int n) {\n  " + name +
               "<<<(n + 255) / 256, 256>>>(a, n);\n  cudaDeviceSynchronize();\n}\n";
    };
    const auto there = [](const std::string& name) {
        return "#include \"kernel.h\"\nvoid run(float* a, int n) {\n  " + name + "(a, n);\n}\n";
    };
    expect_ported({"k.cu", "k.cpp", here("scale"), here("grid_scale"), there("scale"), there("grid_scale")});
}

TEST(SyncEdit, AFunctionThatOneSideDeclaresKeepsItsName) {
    const auto text = [](const std::string& name) { return "void run(float* a, int n) {\n  " + name + "(a, n);\n}\n"; };
    const EditCase one{"k.cu",
                       "k.cpp",
                       text("scale"),
                       text("grid_scale"),
                       "void scale(float* a, int n) {\n  a[0] *= n;\n}\n" + text("scale"),
                       ""};
    EXPECT_NE(synced(one).state(), "proposed");
}

TEST(SyncEdit, ATypeIsSaidAsThePortsOfTheSameFolderSayIt) {
    const auto here = [](const std::string& name, const std::string& body) {
        return "REAL4 " + name + "(REAL4 z, __global sFractal *fractal)\n{\n" + body + "  return z;\n}\n";
    };
    const auto there = [](const std::string& name, const std::string& body) {
        return "CVector4 " + name + "(CVector4 z, const sFractal *fractal)\n{\n" + body + "  return z;\n}\n";
    };
    const std::string plain = "  z += fractal->offset;\n  z *= fractal->scale;\n";
    MemoryDisk disk;
    for (const std::string name : {"fold", "turn", "bend"}) {
        disk.files["/r/src/" + name + ".cl"] =
            here(name, plain + "  REAL part = z.x * fractal->scale;\n  REAL rest = part - z.y;\n  z.x += rest;\n");
        disk.files["/r/port/" + name + ".cpp"] =
            there(name, plain + "  double part = z.x * fractal->scale;\n  double rest = part - z.y;\n  z.x += rest;\n");
    }
    disk.files["/r/src/add.cl"] = here("add", plain);
    disk.files["/r/port/add.cpp"] = there("add", plain);
    ASSERT_EQ(run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    disk.files["/r/src/add.cl"] = here("add", plain + "  REAL half_x = z.x * fractal->scale;\n  z.y += half_x;\n");
    const CommandRun got = run(disk, {"-C", "/r", "sync", "--format", "json"});
    EXPECT_NE(got.out.find("+  double half_x = z.x * fractal->scale;\\n"), std::string::npos) << got.out << got.err;
}

TEST(SyncEdit, AFunctionThatNeitherSideDeclaresIsALibrarys) {
    const std::string head =
        "#include \"reference.h\"\nint run(const int* in, int* out, int n) {\n  launch(in, out, n);\n";
    const std::string gained = "  check_on_host(in, n);\n";
    expect_ported({"k.cu", "k.cpp", head + "  return out[0];\n}\n", head + gained + "  return out[0];\n}\n",
                   head + "  return out[0];\n}\n", head + gained + "  return out[0];\n}\n"});
}

TEST(SyncEdit, WhatADeviceCallsMayBeItsLanguagesOwn) {
    const std::string body = "void f(int* out, int n) {\n  out[0] = n;\n";
    const EditCase one{
        "k.cu",       "k.cpp", "__global__ " + body + "}\n", "__global__ " + body + "  atomicWhatever(out, n);\n}\n",
        body + "}\n", ""};
    EXPECT_NE(synced(one).state(), "proposed");
}

/// Found by fuzzing: the block that the normal form adds had no word of the file after it.
TEST(SyncEdit, ASourceThatEndsInTheMiddleOfABranchIsRead) {
    const std::string head = "void shape(float4& z, Aux& aux) {\n  float4 q = fabs(z) - offset;\n";
    const std::string tail = "  aux.dist = min(aux.dist, q.x);\n}\n";
    const EditCase one{"k.cpp",
                       "k.cl",
                       head + tail,
                       "void shape(float4& z, Aux& aux)\n\t{\n\t\tif (z.z > max(z.y, z.x))",
                       "void shape(float4* z, Aux* aux)\n{\n  float4 q = fabs(*z) - offset;\n"
                       "  aux->dist = min(aux->dist, q.x);\n}\n",
                       ""};
    EXPECT_NE(synced(one).state(), "proposed");
}

/// Each port gave the same as its source before the edit, and would not have after it.
TEST(SyncEdit, WhatWouldBeAnotherEditInThePortIsLeft) {
    const auto sides = [](const std::string& before, const std::string& after, const std::string& port) {
        const std::string head = "float f(const float* k, int n) {\n  float s = 0.0f;\n", end = "  return s;\n}\n";
        return EditCase{
            "k.cu", "k.cpp", "__device__ " + head + before + end, "__device__ " + head + after + end, head + port + end,
            ""};
    };
    // The port's loop over tiles goes on where the source's ends.
    const std::string add = "    s += k[j];\n    if (k[j] > 3.0f) { s += 1.0f; ",
                      loop = "  for (int j = 0; j < n; ++j) {\n";
    expect_left(sides(loop + add + "}\n  }\n", loop + add + "break; }\n  }\n",
                      "  for (int t = 0; t < n; t += 4) {\n    for (int j = t; j < n && j < t + 4; ++j) {\n" + add +
                          "}\n    }\n  }\n"));
    // The break ends the port's case, and the source's loop.
    expect_left(sides(loop + "    if (k[j] == 1) { s += 5.0f; } else if (k[j] == 2) { s += 7.0f; }\n  }\n",
                      loop + "    if (k[j] == 1) { s += 5.0f; } else if (k[j] == 2) { s += 7.0f; break; }\n  }\n",
                      loop + "    switch ((int)k[j]) {\n    case 1: s += 5.0f; break;\n    case 2: s += 7.0f; break;\n"
                             "    }\n  }\n"));
    // The port asks the other way round.
    expect_left(sides("#ifdef FAST\n  s *= 2.0f;\n#else\n  s *= 3.0f;\n#endif\n",
                      "#ifdef FAST\n  s *= 2.0f;\n#else\n  s *= 3.0f;\n  s += 7.0f;\n#endif\n",
                      "#ifndef FAST\n  s *= 3.0f;\n#else\n  s *= 2.0f;\n#endif\n"));
    // A value that is given back is no value that is handed in.
    const std::string body = " b) {\n  a = a + b;\n";
    expect_left({"k.comp", "k.cpp", "void f(inout float a, float" + body + "}\n",
                 "void f(inout float a, out float c, float" + body + "  c = b;\n}\n",
                 "void f(float& a, float" + body + "}\n", ""});
}

TEST(SyncEdit, AConstantGetsAValueOfAnotherKind) {
    const std::string rest = "int f(int a) {\n  return a * SIZE;\n}\n";
    expect_ported({"k.cl", "k.cu", "#define SIZE 32\n" + rest, "#define SIZE (2 * 160 + 4)\n" + rest,
                   "#define SIZE 32\n__device__ " + rest, "#define SIZE (2 * 160 + 4)\n__device__ " + rest});
}

TEST(SyncEdit, ATypeIsKnownFromAParameterThoughThatIsAReferenceThere) {
    const std::string body = "  z = fold(z);\n";
    expect_ported(
        {"k.cl", "k.cpp", "REAL4 turn(REAL4 z, __constant Scale *s)\n{\n" + body + "  return z;\n}\n",
         "REAL4 turn(REAL4 z, __constant Scale *s)\n{\n  REAL4 old = z;\n" + body + "  z += old;\n  return z;\n}\n",
         "void turn(Vector &z, const Scale *s)\n{\n" + body + "}\n",
         "void turn(Vector &z, const Scale *s)\n{\n  Vector old = z;\n" + body + "  z += old;\n}\n"});
}

TEST(SyncEdit, UnlikeStatementsBetweenTheSameNeighboursSayTheSame) {
    const auto text = [](const std::string& head, const std::string& wait, const std::string& between) {
        return head + "  int next = take(data);\n  " + wait + "\n  data[next] = next + 1;\n" + between +
               "  int last = give(data);\n  " + wait + "\n  data[last] = last - 1;\n}\n";
    };
    const std::string cuda = "__global__ void work(int* data) {\n", sycl = "void work(int* data, nd_item<1>& item) {\n";
    const std::string wait = "__syncthreads();", wait_there = "item.barrier(access::fence_space::local_space);";
    expect_ported({"k.cu", "k.cpp", text(cuda, wait, ""), text(cuda, wait, "  " + wait + "\n"),
                   text(sycl, wait_there, ""), text(sycl, wait_there, "  " + wait_there + "\n")});
}

TEST(SyncEdit, AValueOfSeveralPartsIsWrittenAsThePortsFileWritesIt) {
    const std::string cpp = "void fold(Vec4 &z, Vec4 c)\n{\n  z = Vec4(c.x, c.y, c.z, 0.0);\n";
    const std::string cl = "REAL4 fold(REAL4 z, REAL4 c)\n{\n  z = (REAL4){c.x, c.y, c.z, 0.0f};\n";
    const std::string gain = "  z += Vec4(c.y, c.x, 1.0, 1.0);\n",
                      gain_there = "  z += (REAL4){c.y, c.x, 1.0f, 1.0f};\n";
    expect_ported({"k.cpp", "k.cl", cpp + "}\n", cpp + gain + "}\n", cl + "  return z;\n}\n",
                   cl + gain_there + "  return z;\n}\n"});
    expect_ported({"k.cl", "k.cpp", cl + "  return z;\n}\n", cl + gain_there + "  return z;\n}\n", cpp + "}\n",
                   cpp + gain + "}\n"});
}

/// C's literal of a vector has braces, and none of them is a block's.
TEST(SyncEdit, ALiteralWithinASwitchMovesWhole) {
    const std::string turn =
        "  switch (n)\n  {\n    case 1: z = Vec4(z.y, z.x, z.z, z.w); break;\n"
        "    default: z = Vec4(z.z, z.y, z.x, z.w); break;\n  }\n";
    const std::string turn_there =
        "  switch (n)\n  {\n    case 1: z = (REAL4){z.y, z.x, z.z, z.w}; break;\n"
        "    default: z = (REAL4){z.z, z.y, z.x, z.w}; break;\n  }\n";
    const std::string head = "void f(Vec4 &z, int n)\n{\n  z.x = fabs(z.x);\n",
                      head_there = "REAL4 f(REAL4 z, int n)\n{\n  z.x = fabs(z.x);\n";
    const std::string end = "  z.y = fabs(z.y);\n", tail = "  z.z = fabs(z.z);\n";
    expect_ported({"k.cpp", "k.cl", head + turn + end + tail + "}\n", head + end + turn + tail + "}\n",
                   head_there + turn_there + end + tail + "  return z;\n}\n",
                   head_there + end + turn_there + tail + "  return z;\n}\n"});
}

TEST(SyncEdit, ANewLoopGoesAroundWhatThePortHasOfTheSource) {
    const std::string head = "int main(int n) {\n  load(n);\n", work = "  start(n);\n  step(n);\n  stop(n);\n",
                      end = "  clear(n);\n  return 0;\n}\n", loop = "  for (int i = 0; i < 10; i++) {\n";
    expect_ported({"k.cu", "k.cpp", head + work + end, head + loop + work + "  }\n" + end,
                   head + "  device_queue q(n);\n" + work + end,
                   head + "  device_queue q(n);\n" + loop + work + "  }\n" + end});
}

TEST(SyncEdit, ALoopOverTwoCounters) {
    const auto sides = [](const std::string& head, const std::string& loop) {
        return head + "void f(float* out, int n) {\n" + loop + "    out[k] = 1.0f;\n  }\n}\n";
    };
    const std::string old = "  for (int k = 0; k < n; k++) {\n",
                      made = "  for (int i = 0, k = 0; i < n; i += 4, k += 1) {\n";
    expect_ported(
        {"k.cu", "k.cpp", sides("__device__ ", old), sides("__device__ ", made), sides("", old), sides("", made)});
}

TEST(SyncEdit, AHeadThatPicksOtherwiseGetsItsNewNumber) {
    const std::string body = " {\n    ok = false;\n  }\n  return ok;\n}\n";
    const auto cuda = [&](const std::string& number) {
        return "bool f(float2 r, float x) {\n  bool ok = true;\n  if (fabsf(r.x - x) > " + number + ")" + body;
    };
    const auto sycl = [&](const std::string& number) {
        return "bool f(sycl::float2 r, float x) {\n  bool ok = true;\n  if (fabsf(r.x() - x) > " + number + ")" + body;
    };
    expect_ported({"k.cu", "k.cpp", cuda("0.001f"), cuda("0.01f"), sycl("0.001f"), sycl("0.01f")});
}

TEST(SyncEdit, ATypeChangesWhateverTheValueIs) {
    const auto sides = [](const std::string& head, const std::string& type, const std::string& value) {
        return head + "  " + type + " at = " + value + ";\n  out[at] = at * 2 + n;\n}\n";
    };
    const std::string cuda = "__global__ void f(int* out, int n) {\n",
                      sycl = "void f(int* out, int n, nd_item<1>& item) {\n";
    const std::string there = "item.get_global_linear_id()", here = "blockDim.x * blockIdx.x + threadIdx.x";
    expect_ported({"k.cpp", "k.cu", sides(sycl, "int", there), sides(sycl, "size_t", there), sides(cuda, "int", here),
                   sides(cuda, "size_t", here)});
}

/// GLSL alone has one name for both.
TEST(SyncEdit, TheAngleOfTwoNumbersKeepsItsName) {
    const auto cpp = [](const std::string& angle) {
        return "float f(float y, float x)\n{\n  return 2.0f * " + angle + ";\n}\n";
    };
    expect_ported({"k.cpp", "k.cl", cpp("atan(y / x)"), cpp("atan2(y, x)"), cpp("atan(y / x)"), cpp("atan2(y, x)")});
}

/// Both names mean the same to a dialect; with the comma the first one alone would ask for another angle.
TEST(SyncEdit, ANewSpellingGoesWithWhatElseChangesBesideIt) {
    const auto text = [](const std::string& z, const std::string& one, const std::string& angle) {
        return "float f(float4 z, float psi)\n{\n  psi = fabs(fmod(" + angle + " + psi, " + one + " * psi) - " + z +
               ".x);\n  return psi;\n}\n";
    };
    expect_ported({"k.cl", "k.cpp", text("z", "2.0f", "atan(z.y / z.x)"), text("z", "2.0f", "atan2(z.y, z.x)"),
                   text("z", "2.0", "atan(z.y / z.x)"), text("z", "2.0", "atan2(z.y, z.x)")});
}

TEST(SyncEdit, ABuiltInTypeIsKnownOnBothHostSides) {
    const auto text = [](const std::string& sum, const std::string& launch) {
        return "int main(int n) {\n  int sum = n;\n  " + launch + "\n  return sum / " + sum + ";\n}\n";
    };
    expect_ported({"k.cu", "k.cpp", text("n", "step<<<1, 1>>>(n);"), text("(float)n", "step<<<1, 1>>>(n);"),
                   text("n", "step(n);"), text("(float)n", "step(n);")});
}

TEST(SyncEdit, AValueFromElsewhereFollowsItsNewName) {
    const auto text = [](const std::string& scope, const std::string& kind) {
        return "int f(int type) {\n  if (type == " + scope + kind + ") return 1;\n  return type != " + scope + kind +
               ";\n}\n";
    };
    expect_ported({"k.cl", "k.cpp", text("", "lightGlobal"), text("", "lightDirectional"),
                   text("cLight::", "lightGlobal"), text("cLight::", "lightDirectional")});
    // Where the source has the old name still, the two are not one.
    const std::string both =
        "int f(int type) {\n  if (type == lightGlobal) return 1;\n  return type != lightDirectional"
        ";\n}\n";
    expect_left({"k.cl", "k.cpp", text("", "lightGlobal"), both, text("cLight::", "lightGlobal"), ""});
}

TEST(SyncEdit, WhatCppHasInStdAloneIsNotCalledWithoutIt) {
    const auto text = [](const std::string& head, const std::string& value) {
        return head + "int f(int k, int n) {\n  int cap = " + value + ";\n  return cap * 2;\n}\n";
    };
    const std::string old = "k < n ? k : n", made = "min(k, n)", other = "int g(int a) { return max(a, 1); }\n";
    expect_left({"k.cu", "k.cpp", text("__device__ ", old), text("__device__ ", made), text("", old), ""});
    expect_ported({"k.cu", "k.cpp", text("__device__ ", old), text("__device__ ", made),
                   text("using namespace std;\n", old), text("using namespace std;\n", made)});
    expect_ported({"k.cu", "k.cpp", text("__device__ ", old), text("__device__ ", made), other + text("", old),
                   other + text("", made)});
}

TEST(SyncEdit, WhatComesBetweenALambdaOfThePortsAndWhatFollowsItIsLeft) {
    const std::string source =
        "void run(float* a, int n) {\n  for (int k = 0; k < 4; k++) {\n    step(a, n, k);\n    check(a, n);\n  }\n}\n";
    const std::string port =
        "void run(sycl::queue& q, float* a, int n) {\n  for (int k = 0; k < 4; k++) {\n"
        "    q.submit([&](sycl::handler& h) {\n      h.single_task([=]() {\n        step(a, n, k);\n      });\n    "
        "});\n"
        "    check(a, n);\n  }\n}\n";
    expect_left({"k.c", "k.cpp", source, replaced(source, "    check", "    note(a, n);\n    check"), port, ""});
    expect_ported({"k.c", "k.cpp", source, replaced(source, "    check(a, n);", "    check(a, n);\n    note(a, n);"),
                   port, replaced(port, "    check(a, n);", "    check(a, n);\n    note(a, n);")});
}

TEST(SyncEdit, AParameterDoesNotGoWhereThePortStillUsesIt) {
    const std::string source = "float sum(const float* v, const unsigned* flags, int n) {\n  return total(v, n);\n}\n";
    const std::string uses =
        "float sum(const float* v, const unsigned* flags, int n) {\n  mark(flags);\n  return total(v, n);\n}\n";
    const std::string without = "float sum(const float* v, int n) {\n  return total(v, n);\n}\n";
    expect_left({"k.cu", "k.cpp", source, without, uses, ""});
    expect_ported({"k.cu", "k.cpp", source, without, source, without});
}

TEST(SyncEdit, AnArgumentGoesWhateverThePortHasBehindIt) {
    expect_ported(
        {"k.cpp", "k.cu",
         "void pack(int* a, int* unused, const sycl::nd_item<1>& item) {\n  int i = item.get_global_id(0);\n"
         "  a[i] = i;\n}\n",
         "void pack(int* a, const sycl::nd_item<1>& item) {\n  int i = item.get_global_id(0);\n  a[i] = i;\n}\n",
         "__global__ void pack(int* a, int* unused) {\n  int i = blockIdx.x * blockDim.x + threadIdx.x;\n"
         "  a[i] = i;\n}\n",
         "__global__ void pack(int* a) {\n  int i = blockIdx.x * blockDim.x + threadIdx.x;\n  a[i] = i;\n}\n"});
}

TEST(SyncEdit, WhatBothHaveFromElsewhereIsRenamedWhereverThePortHasIt) {
    const std::string source =
        "void load(const gpu_rule_t* r, int n, float* d) {\n  if (n > 4) {\n    d[0] = TO_HALF(r[0].x);\n  }\n}\n";
    const std::string port =
        "void load(const gpu_rule_t* r, int n, float* d) {\n  if (n > 8) {\n    d[0] = TO_HALF(r[0].x);\n"
        "    d[1] = TO_HALF(r[1].x);\n  }\n}\n";
    const auto renamed = [](const std::string& text) {
        std::string out = text;
        for (size_t at = 0; (at = out.find("TO_HALF", at)) != std::string::npos; at += 11)
            out.replace(at, 7, "CPU_TO_HALF");
        return replaced(out, "gpu_rule_t", "kernel_rule_t");
    };
    expect_ported({"k.c", "l.c", source, renamed(source), port, renamed(port)});
    // Where the source keeps the old one as well, it is no other name for it.
    const std::string twice = replaced(source, "  }\n}", "  }\n  d[2] = TO_HALF(r[2].x);\n}");
    expect_left({"k.c", "l.c", twice, replaced(twice, "d[0] = TO_HALF", "d[0] = CPU_TO_HALF"),
                 replaced(port, "  }\n}", "  }\n  d[2] = TO_HALF(r[2].x);\n}"), ""});
}

TEST(SyncEdit, AConstantIsKnownByTheFamilyThatBothFilesHave) {
    const auto text = [](const std::string& head, const std::string& more) {
        return head + "(int op) {\n  switch (op) {\n    case OP_KIND_NORM:\n    case OP_KIND_ADD:\n" + more +
               "      return true;\n    default:\n      return false;\n  }\n}\n";
    };
    expect_ported({"k.cu", "k.cpp", text("bool takes", ""), text("bool takes", "    case OP_KIND_SUB:\n"),
                   text("bool takes", ""), text("bool takes", "    case OP_KIND_SUB:\n")});
    expect_left({"k.cu", "k.cpp", text("bool takes", ""), text("bool takes", "    case MODE_SUB:\n"),
                 text("bool takes", ""), ""});
}

TEST(SyncEdit, AnEmptyLineTellsWhichNeighbourANewStatementGoesWith) {
    const std::string source =
        "int count(const float* v, int n) {\n  prepare(v);\n\n  for (int i = 0; i < n; i++)\n    visit(v, i);\n  "
        "return n;\n}\n";
    const std::string port =
        "int count(const float* v, int n) {\n  prepare(v);\n  Device device;\n  open(device);\n\n"
        "  for (int i = 0; i < n; i++)\n    visit(v, i);\n  return n;\n}\n";
    expect_ported({"k.c", "k.cpp", source, replaced(source, "  for", "  long spent = 0;\n  for"), port,
                   replaced(port, "  for", "  long spent = 0;\n  for")});
    expect_ported({"k.c", "k.cpp", source, replaced(source, "prepare(v);\n", "prepare(v);\n  long spent = 0;\n"), port,
                   replaced(port, "prepare(v);\n", "prepare(v);\n  long spent = 0;\n")});
}

TEST(SyncEdit, AFieldOfTheSourceIsNoParameterOfThePort) {
    expect_left({"k.cpp", "k.cl",
                 "void Lens::Apply(float* out) {\n  float x = 1.0f + out[0] * amount;\n  out[0] = x;\n}\n",
                 "void Lens::Apply(float* out) {\n  float x = 1.0f + out[0] * amountX;\n  out[0] = x;\n}\n",
                 "void Lens_Apply(__global float* out, const float amount) {\n  float x = 1.0f + out[0] * amount;\n"
                 "  out[0] = x;\n}\n",
                 ""});
}

TEST(SyncEdit, ANewCounterMayHaveTheNameThatAMacrosParameterHas) {
    const std::string text =
        "void mix(int* w) {\n  int t = w[0];\n#define STEP(i) t += w[i] + (i);\n  STEP(0);\n  STEP(1);\n  w[0] = t;\n"
        "#undef STEP\n}\n";
    const std::string looped = replaced(text, "  STEP(1);\n", "  for (int i = 1; i < 8; i++) {\n    STEP(i);\n  }\n");
    expect_ported({"k.c", "l.c", text, looped, text, looped});
}

TEST(SyncEdit, AHelperThatThePortHasAlreadyIsUsedThere) {
    const std::string use = "void run(float* a) {\n  a[0] = a[1];\n}\n";
    const std::string helper = "#define MAX_STEP 4\n";
    const std::string other = "#define MAX_STEP 5\n";
    const std::string now = replaced(use, "a[1]", "a[MAX_STEP]");
    expect_ported({"k.c", "l.c", use, helper + now, helper + use, helper + now});
    expect_left({"k.c", "l.c", use, helper + now, other + use, ""});
}

TEST(SyncEdit, AStatementOnlyReadsWhatItsNeighbourReads) {
    const std::string source =
        "void make(int nx, int ny) {\n  char* a = (char*)malloc(nx * ny);\n  float* d = device_array(nx * ny / 2);\n"
        "  fill(a);\n}\n";
    const std::string port = "void make(int nx, int ny) {\n  char* a = (char*)malloc(nx * ny);\n  fill(a);\n}\n";
    const std::string extra = "  char* b = (char*)malloc(nx * ny * 2);\n";
    expect_ported({"k.cpp", "l.cpp", source, replaced(source, "  float* d", extra + "  float* d"), port,
                   replaced(port, "  fill", extra + "  fill")});
}

TEST(SyncEdit, AStatementMayStandElsewhereInThePort) {
    const std::string source =
        "int run(int n) {\n  int total = 0;\n  prepare(n);\n  launch(n);\n  collect(n);\n  return total;\n}\n";
    const std::string port =
        "int run(int n) {\n  prepare(n);\n  launch(n);\n  collect(n);\n  int total = 0;\n  return total;\n}\n";
    // check asks about the other place, so that a person looks.
    const std::string seven = replaced(source, "total = 0", "total = 7");
    const Synced got = synced({"k.c", "l.c", source, seven, port, ""});
    const std::string patch = got.proposal["patch"].is_string() ? got.proposal["patch"] : "";
    EXPECT_NE(patch.find("-  int total = 0;\n+  int total = 7;\n"), std::string::npos) << got.why();
    EXPECT_EQ(got.proposal["left"][0]["source_line"], 2) << got.why();
    EXPECT_EQ(got.proposal["left"][0]["target_line"], 5) << got.why();
    // Of two that say the same neither is it.
    const std::string twice = replaced(port, "  launch(n);\n", "  launch(n);\n  int total = 0;\n");
    expect_left({"k.c", "l.c", source, seven, twice, ""});
}

TEST(SyncEdit, OneRuntimesCallsStandForTheOthers) {
    const auto text = [](const std::string& runtime, const std::string& before, const std::string& behind) {
        return "#include <" + runtime + "/" + runtime + "_runtime.h>\nvoid run(float* a, int n) {\n  " + runtime +
               "Memset(a, 0, n);\n" + before + "  step(a, n);\n  other(a);\n" + behind + "  " + runtime +
               "Free(a);\n}\n";
    };
    const auto waits = [](const std::string& runtime) { return "  " + runtime + "DeviceSynchronize();\n"; };
    const std::string cuda = waits("cuda"), hip = waits("hip");
    expect_ported({"k.cu", "l.cu", text("cuda", cuda, cuda), text("cuda", cuda, ""), text("hip", hip, hip),
                   text("hip", hip, "")});
    expect_ported(
        {"k.cu", "l.cu", text("cuda", "", cuda), text("cuda", cuda, ""), text("hip", "", hip), text("hip", hip, "")});
}

TEST(SyncEdit, WhatCudaHasBesidesItsRunTimeHipHas) {
    const std::string source = "__global__ void sum(float* out, float v) {\n  out[threadIdx.x] = v;\n}\n";
    const std::string edited = replaced(source, "out[threadIdx.x] = v;", "atomicAdd(out, v);");
    const std::string head = "#include <hip/hip_runtime.h>\n";
    expect_ported({"k.cu", "l.cu", source, edited, head + source, head + edited});
}

TEST(SyncEdit, AScopeComesToNamesThatThePortSpellsAlike) {
    const std::string source =
        "#include <cmath>\nint cell(double x, double y) {\n  int i = floor(x);\n"
        "  int k = floor(y);\n  return i + k;\n}\n";
    const std::string scoped = replaced(replaced(source, "floor(x)", "std::floor(x)"), "i + k", "i - k");
    expect_ported({"k.cpp", "l.cpp", source, scoped, source, scoped});
    // The port's own scope, and its own marks of numbers, stay.
    const std::string port = replaced(source, "floor(x)", "math::floor(x)");
    expect_ported({"k.cpp", "l.cpp", source, scoped, port, replaced(port, "i + k", "i - k")});
}

TEST(SyncEdit, WhatBothSidesWriteToOneNameMayBeSaidInTwoWays) {
    const auto text = [](const std::string& scaled, const std::string& more) {
        return "void fold(float* out, float z, float s, float r) {\n  z = z + s;\n  z *= " + scaled + ";\n" + more +
               "  out[0] = z;\n}\n";
    };
    const std::string more = "  if (z > 4.0f) z = 4.0f - z;\n";
    expect_ported({"k.cl", "l.cl", text("s / r", ""), text("s / r", more), text("native_divide(s, r)", ""),
                   text("native_divide(s, r)", more)});
}

TEST(SyncEdit, WhatEachSideHadInItsOwnWordsGoesOnBoth) {
    const auto text = [](const std::string& turned) {
        return "void fold(float* out, const Part* part, float z) {\n  z = z + 1.0f;\n" + turned + "  out[0] = z;\n}\n";
    };
    const auto guarded = [](const std::string& turn) {
        return "  if (part->turn.enabled > 0) {\n    " + turn + "\n  }\n";
    };
    const std::string source = text(guarded("z = part->turn.by.matrix.Rotate(z);"));
    expect_ported(
        {"k.cpp", "l.cl", source, text(""), text(guarded("z = rotated(part->turn.by.matrix, z);")), text("")});
    // What the port has beside it stays.
    expect_left({"k.cpp", "l.cl", source, text(""),
                 text(guarded("z = rotated(part->turn.by.matrix, z);\n    out[1] = z;")), ""});
}

TEST(SyncEdit, AStatementOfOtherValuesIsLeft) {
    const auto text = [](const std::string& scaled) {
        return "void fold(float* out, const Part* part, float z) {\n  z = part->turn.by.first + z;\n  " + scaled +
               "\n  out[0] = z;\n}\n";
    };
    const std::string port = replaced(text("z = turned * part->size.scale;"), "  z = part", "  float turned = part");
    expect_left({"k.cpp", "l.cl", text("z = z * part->size.scale;"), text("z *= part->size.scale + 1;"), port, ""});
}

TEST(SyncEdit, AnotherSpellingIsCarriedWhereItIsAskedForAndThePortHasTheStatement) {
    const auto text = [](const std::string& scaled) {
        return "void fold(float* out, float scale, float z) {\n  z = z + 1;\n  " + scaled + "\n  out[0] = z;\n}\n";
    };
    const auto asked = [&](const std::string& port, const std::vector<std::string>& which) {
        MemoryDisk disk;
        disk.files = {{"/r/s/k.cpp", text("z = z * scale;")}, {"/r/t/k.cl", text(port)}};
        EXPECT_EQ(run(disk, {"-C", "/r", "init", "--source", "s/*", "--target", "t/*"}).exit_code, 0);
        disk.files["/r/s/k.cpp"] = text("z *= scale;");
        std::vector<std::string> arguments = {"-C", "/r", "sync", "--format", "json"};
        arguments.insert(arguments.end(), which.begin(), which.end());
        return nlohmann::json::parse(run(disk, arguments).out)["proposals"];
    };
    const nlohmann::json twin = asked("z = z * scale;", {"s/k.cpp:fold"});
    EXPECT_EQ(twin[0]["state"], "proposed");
    EXPECT_NE(twin[0]["patch"].get<std::string>().find("\n+  z *= scale;\n"), std::string::npos) << twin;
    for (const char* otherwise : {"z *= scale;", "z = turned(z, scale);"}) {
        const nlohmann::json got = asked(otherwise, {"s/k.cpp:fold"});
        EXPECT_EQ(got[0]["state"], "already") << got;
        EXPECT_TRUE(got[0]["patch"].is_null());
    }
    EXPECT_EQ(asked("z = z * scale;", {}).size(), 0u) << "nothing is due";
}

TEST(SyncEdit, WhatStandsBeforeADirectiveGetsALineOfItsOwn) {
    const auto text = [](const std::string& first, const std::string& second) {
        return "void launch(int n) {\n  pick(1, n);\n#ifdef ALL\n  PICK(2, n)\n  PICK(5, n)\n" + first +
               "#else\n  PICK(2, n)\n" + second + "#endif // ALL\n  finish(n);\n}\n";
    };
    const std::string line = "  PICK(4, n)\n";
    for (const auto& [first, second] : {std::pair(line, std::string()), std::pair(std::string(), line)}) {
        const EditCase one{"k.cu", "k.cpp", text("", ""), text(first, second), text("", ""), text(first, second)};
        const Synced got = synced(one);
        if (got.state() != "proposed" && got.state() != "refused") ADD_FAILURE() << got.why();
        EXPECT_EQ(got.port.find(") #"), std::string::npos) << got.port;
        if (got.state() == "proposed") {
            EXPECT_EQ(got.port, one.ported);
        }
    }
    EXPECT_EQ(synced({"k.cu", "k.cpp", text("", ""), text(line, ""), text("", ""), ""}).state(), "proposed");
}

TEST(SyncEdit, ARegionForDataMayHoldWhatStandsBesideItsFirstStatement) {
    const auto source = [](const std::string& clock) {
        return "void run(float* a, int n) {\n  prepare(n);\n  upload();\n" + clock +
               "  for (int i = 0; i < n; i++) step(a, i);\n}\n";
    };
    const auto port = [](const std::string& head, const std::string& clock) {
        return "void run(float* a, int n) {\n  prepare(n);\n" + head + clock +
               "  for (int i = 0; i < n; i++) step(a, i);\n  }\n}\n";
    };
    const std::string clock = "  long start = clock();\n",
                      data = "  #pragma omp target data map(tofrom: a[0:n])\n  {\n";
    expect_ported({"k.cpp", "l.cpp", source(""), source(clock), port(data, ""), port(data, clock)});
    const std::string loop = "  for (int k = 0; k < 2; k++) {\n";
    expect_left({"k.cpp", "l.cpp", source(""), source(clock), port(loop, ""), ""});
    // Nothing comes between a directive and what it governs.
    const std::string copied = replaced(source(""), "upload()", "map(tofrom(a[0], n))");
    const Synced got =
        synced({"k.cpp", "l.cpp", copied, replaced(copied, "  for", clock + "  for"), port(data, ""), ""});
    const std::string patch = got.proposal["patch"].is_string() ? got.proposal["patch"] : "";
    EXPECT_EQ(patch.find("[0:n])\n+"), std::string::npos) << patch;
}

TEST(SyncEdit, ABraceClosesBehindAWholeChoice) {
    const auto text = [](const std::string& open, const std::string& close, const std::string& sum) {
        return "int f(const int* a, int n) {\n    int s = 0;\n    for (int j = 0; j < n; j++)" + open +
               "\n        s += j < 3 ? 0 : (a[j] - n);\n" + close + "    return " + sum + ";\n}\n";
    };
    const Synced got = synced({"k.c", "l.c", text(" {", "    }\n", "s"), text("", "", "s + n"), text("", "", "s"), ""});
    const std::string patch = got.proposal["patch"].is_string() ? got.proposal["patch"] : "";
    EXPECT_NE(patch.find("\n+    return s + n;"), std::string::npos) << got.why();
    EXPECT_EQ(patch.find("\n-        s +="), std::string::npos) << patch;
}

TEST(SyncLayout, AnOperatorThatTookThePlaceOfACloseOneStandsApart) {
    const auto text = [](const std::string& head, const std::string& step) {
        return head + "int f(int n) {\n    for (int i = 0; i < n; " + step + ") n -= 2;\n    return n;\n}\n";
    };
    expect_written({"k.cu", "k.cpp", text("__device__ ", "i++"), text("__device__ ", "i += 4"), text("", "i++"),
                    text("", "i += 4")});
}

TEST(SyncLayout, BracketsAreAsTightAsThePortHasThem) {
    const auto text = [](const std::string& head, const std::string& argument) {
        return head + "float f(float x, float y) {\n    keep(" + argument + ", y);\n    return x;\n}\n";
    };
    expect_written({"k.cu", "k.cpp", text("__device__ ", " x + y "), text("__device__ ", " fabsf( x + y ) "),
                    text("", "x + y"), text("", "fabsf(x + y)")});
}

// Ports that were written in their own way: the same names do not mean the same values there.

struct OtherWay {
    std::string source, port;
};
/// An edit of one line of such a source. `ported`: the port's line and what it becomes; without it the edit is left,
/// and what is carried of it, if anything is, does not have `word`.
struct OtherWayEdit {
    std::string from, to, word;
    std::array<std::string, 2> ported = {};
};

void expect_edits(const OtherWay& way, const std::vector<OtherWayEdit>& edits) {
    for (const OtherWayEdit& edit : edits) {
        SCOPED_TRACE(edit.to);
        const std::string ported = replaced(way.port, edit.ported[0], edit.ported[1]);
        const EditCase one{"k.cu", "k.cpp", way.source, replaced(way.source, edit.from, edit.to), way.port, ported};
        if (!edit.ported[0].empty()) {
            expect_ported(one);
            continue;
        }
        const Synced got = synced(one);
        EXPECT_TRUE(got.state() == "refused" || got.state() == "partial") << got.why() << got.port;
        const std::string patch = got.proposal["patch"].is_string() ? got.proposal["patch"] : "";
        for (size_t at = patch.find("\n+"); at != std::string::npos; at = patch.find("\n+", at + 1))
            EXPECT_EQ(patch.substr(at, patch.find('\n', at + 1) - at).find(edit.word), std::string::npos) << patch;
    }
}

TEST(SyncOtherWay, AWordThatOnlyAnotherFunctionOfThePortHasIsLeft) {
    const OtherWay nearest{
        "struct Hit { float t; int id; int n; };\n"
        "__device__ float pick(const Hit* hits, int n, float tmax) {\n"
        "    float best = tmax;\n    int id = -1;\n"
        "    for (int i = 0; i < n; i++) {\n"
        "        if (hits[i].t < best) {\n            best = hits[i].t;\n            id = hits[i].id;\n        }\n    "
        "}\n"
        "    return id < 0 ? tmax : best;\n}\n"
        "__device__ float twice(const float* in, int i) { return in[i] * 2.0f; }\n",
        "struct Hit { float t; int id; int n; };\n"
        "float pick(const std::vector<Hit>& hits, float tmax) {\n"
        "  float nearest = tmax;\n  int which = -1;\n"
        "  for (const Hit& hit : hits) {\n"
        "    if (hit.t < nearest) {\n      nearest = hit.t;\n      which = hit.id;\n    }\n  }\n"
        "  return which < 0 ? tmax : nearest;\n}\n"
        "float twice(const float* in, int i) { return in[i] * 2.0f; }\n"};
    expect_edits(nearest,
                 {{"hits[i].t < best", "hits[i].t < best && i > 2", "i > 2"},
                  {"hits[i].t < best", "hits[i].t < best && hits[i].id != i", "!= i"},
                  {"hits[i].t < best", "hits[i].t < best && n > 2", "n > 2"},
                  {"float best = tmax;", "float best = tmax;\n    tmax = id;", "tmax ="},
                  {"id < 0 ?", "id < 0 || best > 9.0f ?", "", {"which < 0 ?", "which < 0 || nearest > 9.0f ?"}},
                  {"hits[i].t < best", "hits[i].t < best * 2.0f", "", {"hit.t < nearest", "hit.t < nearest * 2.0f"}}});
    const OtherWay fade{
        "__device__ float fade(float x, float len) {\n    float inv = 1.0f / len;\n    float r = x * inv;\n    return "
        "r * r;\n}\n"
        "__device__ float norm(float x, float y) {\n    float inv = 1.0f / sqrtf(x * x + y * y);\n    return x * "
        "inv;\n}\n",
        "float fade(float x, float len) {\n  const float r = x / len;\n  return r * r;\n}\n"
        "float norm(float x, float y) {\n  const float inv = 1.0f / std::sqrt(x * x + y * y);\n  return x * inv;\n}\n"};
    expect_edits(fade, {{"return r * r;", "return r * r * inv;", "inv"},
                        {"    return r * r;", "    r *= 2.0f;\n    return r * r;", "r *="},
                        {"return r * r;", "return r * r * len;", "", {"return r * r;", "return r * r * len;"}}});
}

TEST(SyncOtherWay, AVariableIsNotAnotherOneThatIsWrittenOtherwise) {
    expect_edits(
        {"__device__ float noise(int n, float t) {\n    float acc = 0.0f;\n    float amp = 1.0f;\n"
         "    while (n > 0) {\n        acc += amp * t;\n        amp *= 0.5f;\n        n--;\n    }\n    return "
         "acc;\n}\n",
         "float noise(int octaves, float t) {\n  float acc = 0.0f;\n  float amp = 1.0f;\n"
         "  for (int k = 0; k < octaves; ++k) {\n    acc += amp * t;\n    amp *= 0.5f;\n  }\n  return acc;\n}\n"},
        {{"acc += amp * t;", "acc += amp * t / n;", "octaves"},
         {"acc += amp * t;", "acc += amp * t + acc;", "", {"acc += amp * t;", "acc += amp * t + acc;"}}});
    expect_edits({"__device__ float gain(float v, int level) {\n    float k = v;\n    level = level + 1;\n    k = k * "
                  "level;\n    return k;\n}\n",
                  "float gain(float v, int level) {\n  float k = v;\n  k = k * (level + 1);\n  return k;\n}\n"},
                 {{"return k;", "return level > 3 ? 1.0f : k;", "level > 3"},
                  {"return k;", "return v > 3.0f ? 1.0f : k;", "", {"return k;", "return v > 3.0f ? 1.0f : k;"}}});
    expect_edits({"__device__ float decay(float v, float dt) {\n    v = v * dt;\n    float out = v + 1.0f;\n    return "
                  "out;\n}\n",
                  "float decay(float v, float dt) {\n  const float scaled = v * dt;\n  const float out = scaled + "
                  "1.0f;\n  return out;\n}\n"},
                 {{"out = v + 1.0f", "out = v + v + 1.0f", "+ v"},
                  {"return out;", "return out + v;", "+ v"},
                  {"return out;", "return out + dt;", "", {"return out;", "return out + dt;"}}});
    expect_edits(
        {"__device__ int find(const int* a, int n, int key) {\n    int lo = 0;\n    int hi = n;\n    while (lo < hi) "
         "{\n"
         "        int mid = (lo + hi) / 2;\n        if (a[mid] < key) lo = mid + 1;\n        else hi = mid;\n    }\n   "
         " return lo;\n}\n",
         "int find(const int* a, int n, int key) {\n  int first = 0;\n  int last = n - 1;\n  while (first <= last) {\n"
         "    int mid = (first + last) / 2;\n    if (a[mid] < key) first = mid + 1;\n    else last = mid - 1;\n  }\n  "
         "return first;\n}\n"},
        {{"int hi = n;", "int hi = n;\n    if (hi == 0) return -1;", "last"},
         {"return lo;", "return hi - lo;", "last"},
         {"int hi = n;",
          "int hi = n;\n    if (n == 0) return -1;",
          "",
          {"int last = n - 1;", "int last = n - 1;\n  if (n == 0) return -1;"}}});
}

TEST(SyncOtherWay, AThreadsIndexIsTheCounterOfTheLoopThatThePortHasForIt) {
    expect_edits(
        {"__global__ void blur(const float* in, float* out, int w, int h) {\n"
         "    int x = blockIdx.x * blockDim.x + threadIdx.x;\n    int y = blockIdx.y * blockDim.y + threadIdx.y;\n"
         "    if (x >= w || y >= h) return;\n    float v = in[y * w + x] * 0.5f;\n    out[y * w + x] = v;\n}\n",
         "void blur(const float* in, float* out, int w, int h) {\n  for (int y = 0; y < h; ++y) {\n    for (int x = 0; "
         "x < w; ++x) {\n"
         "      float v = in[y * w + x] * 0.5f;\n      out[y * w + x] = v;\n    }\n  }\n}\n"},
        {{"* 0.5f;", "* 0.5f + x;", "", {"* 0.5f;", "* 0.5f + x;"}}});
}

}  // namespace
}  // namespace porttool::testing
