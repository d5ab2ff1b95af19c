// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Edits whose place or words a port has in its own manner. Each port is as a person would write it.
#include "tests/porttool/synced_repository.h"

namespace porttool::testing {
namespace sync_manner_test {

class SyncManner : public SyncedRepository {};

TEST_F(SyncManner, ANameOfAnotherBlockMayBeDeclaredAnew) {
    start("k.cl",
          "float fold(float p, float q, int turn) {\n"
          "    float out = p;\n"
          "    if (turn == 1) {\n"
          "        float temp = p;\n"
          "        p = q;\n"
          "        q = temp;\n"
          "    }\n"
          "    out += p * q;\n"
          "    return out;\n"
          "}\n",
          "k.cpp",
          "float fold(float p, float q, int turn) {\n"
          "  float out = p;\n"
          "  if (turn == 1) {\n"
          "    std::swap(p, q);\n"
          "  }\n"
          "  out += p * q;\n"
          "  return out;\n"
          "}\n");
    expect_written(
        "float fold(float p, float q, int turn) {\n"
        "    float out = p;\n"
        "    if (turn == 1) {\n"
        "        float temp = p;\n"
        "        p = q;\n"
        "        q = temp;\n"
        "    }\n"
        "    out += p * q;\n"
        "    if (turn == 2) {\n"
        "        float temp = out * out;\n"
        "        out = temp + 1.0f;\n"
        "    }\n"
        "    return out;\n"
        "}\n",
        "float fold(float p, float q, int turn) {\n"
        "  float out = p;\n"
        "  if (turn == 1) {\n"
        "    std::swap(p, q);\n"
        "  }\n"
        "  out += p * q;\n"
        "  if (turn == 2) {\n"
        "    float temp = out * out;\n"
        "    out = temp + 1.0f;\n"
        "  }\n"
        "  return out;\n"
        "}\n");
}

TEST_F(SyncManner, ALocalBehindAMacroIsOne) {
    start("k.cl",
          "KERNEL_FN void fill(GLOBAL_AS u32* out, const u32 n) {\n"
          "  const u32 lid = get_local_id(0);\n"
          "  out[lid] = n;\n"
          "  for (u32 i = 0; i < n; i++) out[i] += lid;\n"
          "}\n",
          "m.cl",
          "KERNEL_FN void fill(GLOBAL_AS u32* out, const u32 n) {\n"
          "  const u32 lid = get_local_id(0);\n"
          "  out[lid] = n;\n"
          "  for (u32 i = 0; i < n; i++) out[i] += lid;\n"
          "}\n");
    expect_written(
        "KERNEL_FN void fill(GLOBAL_AS u32* out, const u32 n) {\n"
        "  const u32 lid = get_local_id(0);\n"
        "  #ifdef REAL_SHM\n"
        "  LOCAL_VK u32 tile[256];\n"
        "  for (MAYBE_VOLATILE u32 i = lid; i < 256; i += 64) {\n"
        "    tile[i] = n;\n"
        "  }\n"
        "  #endif\n"
        "  out[lid] = n;\n"
        "  for (u32 i = 0; i < n; i++) out[i] += lid;\n"
        "}\n",
        "KERNEL_FN void fill(GLOBAL_AS u32* out, const u32 n) {\n"
        "  const u32 lid = get_local_id(0);\n"
        "  #ifdef REAL_SHM\n"
        "  LOCAL_VK u32 tile[256];\n"
        "  for (MAYBE_VOLATILE u32 i = lid; i < 256; i += 64) {\n"
        "    tile[i] = n;\n"
        "  }\n"
        "  #endif\n"
        "  out[lid] = n;\n"
        "  for (u32 i = 0; i < n; i++) out[i] += lid;\n"
        "}\n");
}

TEST_F(SyncManner, OpenClHasWhatCHasForNumbers) {
    start("k.cpp",
          "float snap(float x, float step) {\n"
          "    float y = x / step;\n"
          "    return y * step;\n"
          "}\n",
          "k.cl",
          "float snap(float x, float step) {\n"
          "  float y = x / step;\n"
          "  return y * step;\n"
          "}\n");
    expect_written(
        "float snap(float x, float step) {\n"
        "    float y = x / step;\n"
        "    return round(y) * step;\n"
        "}\n",
        "float snap(float x, float step) {\n"
        "  float y = x / step;\n"
        "  return round(y) * step;\n"
        "}\n");
}

TEST_F(SyncManner, ATypeIsThatOfAParameterHoweverItIsHandedOver) {
    start("k.cpp",
          "void turn(Vec4 &z, const Setup *setup) {\n"
          "    z = z * setup->scale;\n"
          "    z += Vec4(setup->a, setup->b, 0.0, 0.0);\n"
          "}\n",
          "k.cl",
          "REAL4 turn(REAL4 z, __constant Setup *setup) {\n"
          "  z = z * setup->scale;\n"
          "  z += (REAL4)(setup->a, setup->b, 0.0f, 0.0f);\n"
          "  return z;\n"
          "}\n");
    expect_written(
        "void turn(Vec4 &z, const Setup *setup) {\n"
        "    z = z * setup->scale;\n"
        "    Vec4 kept = z;\n"
        "    kept *= setup->rate;\n"
        "    z += kept;\n"
        "    z += Vec4(setup->a, setup->b, 0.0, 0.0);\n"
        "}\n",
        "REAL4 turn(REAL4 z, __constant Setup *setup) {\n"
        "  z = z * setup->scale;\n"
        "  REAL4 kept = z;\n"
        "  kept *= setup->rate;\n"
        "  z += kept;\n"
        "  z += (REAL4)(setup->a, setup->b, 0.0f, 0.0f);\n"
        "  return z;\n"
        "}\n");
}

TEST_F(SyncManner, ATextThatSaysTheSameBecomesWhatTheSourceSays) {
    start("k.cu",
          "void report(float time) {\n"
          "    printf(\"Average kernel time on the device: %f\\n\", time);\n"
          "    done();\n"
          "}\n",
          "k.cpp",
          "void report(float time) {\n"
          "  printf(\"Average kernel time the device: %f\\n\", time);\n"
          "  done();\n"
          "}\n");
    expect_written(
        "void report(float time) {\n"
        "    printf(\"Average kernel execution time: %f\\n\", time);\n"
        "    done();\n"
        "}\n",
        "void report(float time) {\n"
        "  printf(\"Average kernel execution time: %f\\n\", time);\n"
        "  done();\n"
        "}\n");
}

TEST_F(SyncManner, ATextWithWordsOfItsOwnIsLeft) {
    start("k.cu",
          "void report(float time) {\n"
          "    printf(\"Average kernel time: %f\\n\", time);\n"
          "    done();\n"
          "}\n",
          "k.cpp",
          "void report(float time) {\n"
          "  printf(\"Average offload time of the kernel: %f\\n\", time);\n"
          "  done();\n"
          "}\n");
    EXPECT_NE(proposal_of("void report(float time) {\n"
                          "    printf(\"Average kernel execution time: %f\\n\", time);\n"
                          "    done();\n"
                          "}\n")["state"],
              "proposed");
    EXPECT_EQ(port_now(),
              "void report(float time) {\n"
              "  printf(\"Average offload time of the kernel: %f\\n\", time);\n"
              "  done();\n"
              "}\n");
}

TEST_F(SyncManner, WhereAParameterLiesIsNotWhereALocalPointsTo) {
    start("k.cl",
          "__kernel void mix_words(__constant u32* words, __global u32* out) {\n"
          "  const u32 lid = get_local_id(0);\n"
          "  out[lid] = words[lid];\n"
          "}\n",
          "m.cl",
          "__kernel void mix_words(__global u32* words, __global u32* out) {\n"
          "  const u32 lid = get_local_id(0);\n"
          "  out[lid] = words[lid];\n"
          "}\n");
    expect_written(
        "__kernel void mix_words(__constant u32* words, __global u32* out) {\n"
        "  const u32 lid = get_local_id(0);\n"
        "  __constant u32* table = kTable;\n"
        "  out[lid] = words[lid] + table[lid];\n"
        "}\n",
        "__kernel void mix_words(__global u32* words, __global u32* out) {\n"
        "  const u32 lid = get_local_id(0);\n"
        "  __constant u32* table = kTable;\n"
        "  out[lid] = words[lid] + table[lid];\n"
        "}\n");
}

TEST_F(SyncManner, ALineThatGetsBracesIsBroken) {
    start("k.cu",
          "float pick(float a, float b) {\n"
          "    float out = 0.0f;\n"
          "    if (a > b) out = a;\n"
          "    else out = b;\n"
          "    return out;\n"
          "}\n",
          "k.cpp",
          "float pick(float a, float b) {\n"
          "  float out = 0.0f;\n"
          "  if (a > b) out = a;\n"
          "  else out = b;\n"
          "  return out;\n"
          "}\n");
    expect_written(
        "float pick(float a, float b) {\n"
        "    float out = 0.0f;\n"
        "    if (a > b) {\n"
        "        out = a;\n"
        "    }\n"
        "    else {\n"
        "        if (b > 2.0f) {\n"
        "            out = b;\n"
        "        }\n"
        "        else {\n"
        "            out = 1.0f;\n"
        "        }\n"
        "    }\n"
        "    return out;\n"
        "}\n",
        "float pick(float a, float b) {\n"
        "  float out = 0.0f;\n"
        "  if (a > b) {\n"
        "    out = a;\n"
        "  }\n"
        "  else {\n"
        "    if (b > 2.0f) {\n"
        "      out = b;\n"
        "    }\n"
        "    else {\n"
        "      out = 1.0f;\n"
        "    }\n"
        "  }\n"
        "  return out;\n"
        "}\n");
}

TEST_F(SyncManner, AQueueIsWaitedForWhereTheDeviceIs) {
    start("k.cu",
          "void run(float* data, int n) {\n"
          "    launch(data, n);\n"
          "    report(n);\n"
          "}\n",
          "k.cpp",
          "void run(sycl::queue& q, float* data, int n) {\n"
          "  launch(q, data, n);\n"
          "  report(n);\n"
          "}\n");
    expect_written(
        "void run(float* data, int n) {\n"
        "    launch(data, n);\n"
        "    cudaDeviceSynchronize();\n"
        "    report(n);\n"
        "}\n",
        "void run(sycl::queue& q, float* data, int n) {\n"
        "  launch(q, data, n);\n"
        "  q.wait();\n"
        "  report(n);\n"
        "}\n");
}

TEST_F(SyncManner, AParameterComesBeforeAllOfTheNextOne) {
    start("k.cu",
          "__device__ void add(int first, float* out, float value) {\n"
          "    out[first] += value;\n"
          "}\n",
          "k.cl",
          "void add(int first, __global float* out, float value) {\n"
          "  out[first] += value;\n"
          "}\n");
    expect_written(
        "__device__ void add(int first, int id, float* out, float value) {\n"
        "    out[first + id] += value;\n"
        "}\n",
        "void add(int first, int id, __global float* out, float value) {\n"
        "  out[first + id] += value;\n"
        "}\n");
}

TEST_F(SyncManner, APartOfATypeIsNotExchanged) {
    start("k.cu",
          "void sizes(int n) {\n"
          "    int bytes = 4 * n;\n"
          "    report(bytes);\n"
          "}\n",
          "k.cpp",
          "void sizes(int n) {\n"
          "  unsigned int bytes = 4 * n;\n"
          "  report(bytes);\n"
          "}\n");
    expect_left(
        "void sizes(int n) {\n"
        "    size_t bytes = 4 * n;\n"
        "    report(bytes);\n"
        "}\n",
        "another type", 2);
}

TEST_F(SyncManner, AFieldIsNotInitializedWhereThePortInitializesItsBase) {
    start("k.cu",
          "Shift::Shift(int sysdef, int seed)\n"
          "    : Updater(sysdef), m_seed(seed) {\n"
          "    notice(seed);\n"
          "}\n",
          "k.cpp",
          "ShiftGpu::ShiftGpu(int sysdef, int seed)\n"
          "  : Shift(sysdef, seed) {\n"
          "  notice(seed);\n"
          "}\n");
    const nlohmann::json got = proposal_of(
        "Shift::Shift(int sysdef, int seed, int trigger)\n"
        "    : Updater(sysdef), m_seed(seed), m_trigger(trigger) {\n"
        "    notice(seed);\n"
        "}\n");
    EXPECT_NE(got["state"], "proposed") << got.dump(1);
    EXPECT_EQ(got["left"].back()["target_line"], 2) << got.dump(1);
}

TEST_F(SyncManner, QualifiersAreCarriedWhereSomebodyAsks) {
    const std::string before = "__global__ void add(float* in, float* out) {\n    out[0] += in[0];\n}\n";
    start("k.cu", before, "k.hip", before);
    const std::string now =
        "__global__ void add(const float* __restrict__ in, float* __restrict__ out) {\n    out[0] += in[0];\n}\n";
    write(source_path, now);
    EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0) << "nothing is due";
    EXPECT_TRUE(nlohmann::json::parse(porttool({"sync", "--format", "json"}).out)["proposals"].empty());
    const nlohmann::json got =
        nlohmann::json::parse(porttool({"sync", "src/k.cu:add", "--format", "json"}).out)["proposals"][0];
    ASSERT_EQ(got["state"], "proposed") << got.dump(1);
    ASSERT_EQ(porttool({"sync", "src/k.cu:add", "--apply"}).exit_code, 0);
    EXPECT_EQ(port_now(), now);
}

TEST_F(SyncManner, OneMoreArgumentIsNoOtherValue) {
    start("k.cu",
          "__device__ void search(const Image in, float* score, const float limit) {\n"
          "    const int x = threadIdx.x + 3;\n"
          "    search_core(local_now, score, in.dims[0], in.dims[1], limit, x);\n"
          "}\n",
          "k.cl",
          "void search(__global const float* in, Info info, __global float* score, const float limit,\n"
          "            __local float* local_image) {\n"
          "  const int x = get_local_id(0) + 3;\n"
          "  search_core(local_image, score, info, limit, x);\n"
          "}\n");
    expect_written(
        "__device__ void search(const Image in, float* score, const float limit, const int edge) {\n"
        "    const int x = threadIdx.x + edge;\n"
        "    search_core(local_now, score, in.dims[0], in.dims[1], limit, x, edge);\n"
        "}\n",
        "void search(__global const float* in, Info info, __global float* score, const float limit, const int edge,\n"
        "            __local float* local_image) {\n"
        "  const int x = get_local_id(0) + edge;\n"
        "  search_core(local_image, score, info, limit, x, edge);\n"
        "}\n");
}

TEST_F(SyncManner, ACallWithOtherArgumentsIsTheCallThatItWas) {
    start("k.cl",
          "void hash(u32* w, u32* dgst, u32 n) {\n"
          "  w[n] = 0;\n"
          "  u32 left = dgst[n] * 2;\n"
          "  transport(w, left, TABLE);\n"
          "  dgst[n] = w[n] + 1;\n"
          "}\n",
          "m.cl",
          "void hash(u32* w, u32* dgst, u32 n) {\n"
          "  w[n] = 0;\n"
          "  transport(w, dgst[n] * 2, TABLE);\n"
          "  dgst[n] = w[n] + 1;\n"
          "}\n");
    expect_written(
        "void hash(u32* w, u32* dgst, u32 n) {\n"
        "  w[n] = 0;\n"
        "  u32 left = dgst[n] * 2;\n"
        "  transport(w, left, TABLE0, TABLE1, TABLE2, TABLE3, TABLE4, TABLE5, TABLE6);\n"
        "  dgst[n] = w[n] + 1;\n"
        "}\n",
        "void hash(u32* w, u32* dgst, u32 n) {\n"
        "  w[n] = 0;\n"
        "  transport(w, dgst[n] * 2, TABLE0, TABLE1, TABLE2, TABLE3, TABLE4, TABLE5, TABLE6);\n"
        "  dgst[n] = w[n] + 1;\n"
        "}\n");
}

TEST_F(SyncManner, AConditionOfThePreprocessorMayGoByAnotherName) {
    start("k.cpp",
          "void run(int vid, int n) {\n"
          "  switch (vid) {\n"
          "    case Base_Seq: {\n"
          "      start();\n"
          "      body(n);\n"
          "      stop();\n"
          "      break;\n"
          "    }\n"
          "#if defined(RUN_LOOPS_SEQ)\n"
          "    case Loops_Seq: {\n"
          "      start();\n"
          "      forall(0, n);\n"
          "      stop();\n"
          "      break;\n"
          "    }\n"
          "#endif\n"
          "    default: {\n"
          "      warn(vid);\n"
          "    }\n"
          "  }\n"
          "}\n",
          "m.cpp",
          "void run(int vid, int n) {\n"
          "  switch (vid) {\n"
          "    case Base_OpenMP: {\n"
          "      start();\n"
          "      body(n);\n"
          "      stop();\n"
          "      break;\n"
          "    }\n"
          "#if defined(RUN_OPENMP)\n"
          "    case Loops_OpenMP: {\n"
          "      start();\n"
          "      forall(0, n);\n"
          "      stop();\n"
          "      break;\n"
          "    }\n"
          "#endif\n"
          "    default: {\n"
          "      warn(vid);\n"
          "    }\n"
          "  }\n"
          "}\n");
    expect_written(
        "void run(int vid, int n) {\n"
        "  switch (vid) {\n"
        "    case Base_Seq: {\n"
        "      start();\n"
        "      body(n);\n"
        "      stop();\n"
        "      break;\n"
        "    }\n"
        "#if defined(RUN_LOOPS_SEQ)\n"
        "    case Loops_Seq: {\n"
        "      start();\n"
        "      forall(1, n);\n"
        "      stop();\n"
        "      break;\n"
        "    }\n"
        "#endif\n"
        "    default: {\n"
        "      warn(vid);\n"
        "    }\n"
        "  }\n"
        "}\n",
        "void run(int vid, int n) {\n"
        "  switch (vid) {\n"
        "    case Base_OpenMP: {\n"
        "      start();\n"
        "      body(n);\n"
        "      stop();\n"
        "      break;\n"
        "    }\n"
        "#if defined(RUN_OPENMP)\n"
        "    case Loops_OpenMP: {\n"
        "      start();\n"
        "      forall(1, n);\n"
        "      stop();\n"
        "      break;\n"
        "    }\n"
        "#endif\n"
        "    default: {\n"
        "      warn(vid);\n"
        "    }\n"
        "  }\n"
        "}\n");
}

TEST_F(SyncManner, AConditionTheOtherWayRoundIsLeft) {
    start("k.cpp",
          "void run(int vid, int n) {\n"
          "  switch (vid) {\n"
          "    case Base_Seq: {\n"
          "      start();\n"
          "      body(n);\n"
          "      stop();\n"
          "      break;\n"
          "    }\n"
          "#if defined(RUN_LOOPS_SEQ)\n"
          "    case Loops_Seq: {\n"
          "      start();\n"
          "      forall(0, n);\n"
          "      stop();\n"
          "      break;\n"
          "    }\n"
          "#endif\n"
          "    default: {\n"
          "      warn(vid);\n"
          "    }\n"
          "  }\n"
          "}\n",
          "m.cpp",
          "void run(int vid, int n) {\n"
          "  switch (vid) {\n"
          "    case Base_OpenMP: {\n"
          "      start();\n"
          "      body(n);\n"
          "      stop();\n"
          "      break;\n"
          "    }\n"
          "#ifndef RUN_OPENMP\n"
          "    case Loops_OpenMP: {\n"
          "      start();\n"
          "      forall(0, n);\n"
          "      stop();\n"
          "      break;\n"
          "    }\n"
          "#endif\n"
          "    default: {\n"
          "      warn(vid);\n"
          "    }\n"
          "  }\n"
          "}\n");
    EXPECT_NE(proposal_of("void run(int vid, int n) {\n"
                          "  switch (vid) {\n"
                          "    case Base_Seq: {\n"
                          "      start();\n"
                          "      body(n);\n"
                          "      stop();\n"
                          "      break;\n"
                          "    }\n"
                          "#if defined(RUN_LOOPS_SEQ)\n"
                          "    case Loops_Seq: {\n"
                          "      start();\n"
                          "      forall(1, n);\n"
                          "      stop();\n"
                          "      break;\n"
                          "    }\n"
                          "#endif\n"
                          "    default: {\n"
                          "      warn(vid);\n"
                          "    }\n"
                          "  }\n"
                          "}\n")["state"],
              "proposed");
}

TEST_F(SyncManner, ANumberGetsTheMarkThatMostHave) {
    start("k.cpp",
          "double grow(double x, double y) {\n"
          "    double a = x * 2.0;\n"
          "    double b = y * 3.0 + 0.5;\n"
          "    double c = a * 0.25;\n"
          "    double d = b + 8.0;\n"
          "    return c + d;\n"
          "}\n",
          "k.cl",
          "REAL grow(REAL x, REAL y) {\n"
          "  REAL a = x * 2.0f;\n"
          "  REAL b = y * 3.0f + 0.5f;\n"
          "  REAL c = a * 0.25f;\n"
          "  REAL d = b + 8.0;\n"
          "  return c + d;\n"
          "}\n");
    expect_written(
        "double grow(double x, double y) {\n"
        "    double a = x * 2.0;\n"
        "    double b = y * 3.0 + 0.5;\n"
        "    double c = a * 0.75;\n"
        "    double d = b + 8.0;\n"
        "    return c - d - 1.5;\n"
        "}\n",
        "REAL grow(REAL x, REAL y) {\n"
        "  REAL a = x * 2.0f;\n"
        "  REAL b = y * 3.0f + 0.5f;\n"
        "  REAL c = a * 0.75f;\n"
        "  REAL d = b + 8.0;\n"
        "  return c - d - 1.5f;\n"
        "}\n");
}

}  // namespace sync_manner_test
}  // namespace porttool::testing
