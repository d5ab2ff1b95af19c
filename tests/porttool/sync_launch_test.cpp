// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Host code that starts kernels: in a statement here, in a block around the kernel there.
#include "tests/porttool/synced_repository.h"

namespace porttool::testing {
namespace sync_launch_test {

class SyncLaunch : public SyncedRepository {
protected:
    void expect_in_patch(const std::string& now, const std::string& line) {
        const nlohmann::json got = proposal_of(now);
        ASSERT_TRUE(got["patch"].is_string()) << got.dump(1);
        EXPECT_NE(got["patch"].get<std::string>().find(line), std::string::npos) << got.dump(1);
    }
    void expect_already(const std::string& now) {
        write(source_path, now);
        const nlohmann::json all = nlohmann::json::parse(porttool({"sync", "--all", "--format", "json"}).out);
        for (const nlohmann::json& one : all["proposals"]) EXPECT_EQ(one["state"], "already") << one.dump(1);
    }
};

const std::string kStart = "  auto start = std::chrono::steady_clock::now();\n";
const std::string kEnd = "  auto end = std::chrono::steady_clock::now();\n";

/// `before` and `behind`: what stands beside the launch.
std::string cuda_run(const std::string& before, const std::string& behind) {
    return "void run(float* a, int n) {\n  prepare(a, n);\n\n" + before + "  work<<<n / 64, 64>>>(a, n);\n" + behind +
           "\n  finish(a, n);\n}\n";
}

std::string sycl_run(const std::string& before, const std::string& behind, const std::string& end = "  });\n") {
    return "void run(sycl::queue& q, float* a, int n) {\n  prepare(a, n);\n\n  sycl::range<1> groups(n / 64);\n" +
           before +
           "  q.submit([&](sycl::handler& h) {\n"
           "    h.parallel_for(sycl::nd_range<1>(groups, 64), [=](sycl::nd_item<1> item) {\n"
           "      work(a, n, item);\n    });\n" +
           end + behind + "\n  finish(a, n);\n}\n";
}

std::string omp_run(const std::string& before, const std::string& behind) {
    return "void run(float* a, int n) {\n  prepare(a, n);\n\n" + before +
           "  #pragma omp target teams distribute parallel for\n  for (int i = 0; i < n; ++i) {\n    a[i] = a[i] * "
           "2.0f;\n  }\n" +
           behind + "\n  finish(a, n);\n}\n";
}

TEST_F(SyncLaunch, WhatComesBesideOneComesBesideTheBlockThatSubmitsIt) {
    start("k.cu", cuda_run("", ""), "k.cpp", sycl_run("", ""));
    const std::string sync = "  cudaDeviceSynchronize();\n", wait = "  q.wait();\n";
    expect_ported(cuda_run(sync + kStart + "\n", "\n" + sync + kEnd), sycl_run(wait + kStart, wait + kEnd));
}

TEST_F(SyncLaunch, AWaitThatThePortHasStays) {
    const std::string sync = "  cudaDeviceSynchronize();\n", wait = "  q.wait();\n";
    start("k.cu", cuda_run("", ""), "k.cpp", sycl_run("", wait));
    expect_ported(cuda_run("", "\n" + sync + kEnd), sycl_run("", wait + kEnd));
}

TEST_F(SyncLaunch, WithoutItsLikeTheOrderOfWhatStoodAroundItIsLeft) {
    const std::string port = "void run(float* a, int n) {\n  prepare(a, n);\n  finish(a, n);\n}\n";
    start("k.cu", cuda_run("", ""), "k.cpp", port);
    write(source_path, cuda_run(kStart + "\n", "\n" + kEnd));
    const std::string all = porttool({"sync", "--format", "json"}).out;
    EXPECT_NE(all.find("has no counterpart there"), std::string::npos) << all;
}

TEST_F(SyncLaunch, AClockWaitsForWhatThePortOnlyStarted) {
    start("k.cpp", omp_run("", ""), "k_sycl.cpp", sycl_run("", ""));
    expect_written(omp_run("", "\n" + kEnd), sycl_run("", "\n  q.wait();\n" + kEnd));
}

TEST_F(SyncLaunch, AClockDoesNotRunAheadWhereNothingTellsHowThePortWaits) {
    const std::string port = replaced(sycl_run("", ""), "sycl::queue& q, ", "sycl::queue& q, sycl::queue& other, ");
    start("k.cpp", omp_run("", ""), "k_sycl.cpp", port);
    expect_left(omp_run("", "\n" + kEnd), "does not wait there", 9);
}

TEST_F(SyncLaunch, WhatComesBeforeTheClockMayTakeTimeOfItsOwn) {
    start("k.cpp", omp_run("", ""), "k_sycl.cpp", sycl_run("", ""));
    expect_left(omp_run("", "\n  tidy(a, n);\n" + kEnd), "does not wait there", 9);
}

TEST_F(SyncLaunch, AWaitIsNothingWhereDirectivesWaitOfThemselves) {
    const std::string sync = "  cudaDeviceSynchronize();\n";
    const auto host = [](const std::string& count, const std::string& before, const std::string& launch,
                         const std::string& behind) {
        return "void run(float* a, int n" + count + ") {\n  prepare(a, n);\n" + before + "  for (int i = 0; i < " +
               (count.empty() ? "100" : "times") + "; ++i)\n    " + launch + behind + "  finish(a, n);\n}\n";
    };
    const std::string kernel =
        "void work(float* a, int n) {\n  #pragma omp target teams distribute parallel for\n"
        "  for (int i = 0; i < n; ++i) a[i] = a[i] * 2.0f;\n}\n";
    const std::string cuda = "work<<<n / 64, 64>>>(a, n);\n", call = "work(a, n);\n", times = ", int times";
    start("k.cu", host("", "", cuda, ""), "k.cpp", kernel + host("", "", call, ""));
    expect_ported(host(times, sync + kStart, cuda, sync + kEnd), kernel + host(times, kStart, call, kEnd));
}

TEST_F(SyncLaunch, ADirectiveThatIsAStatementGovernsNothing) {
    const auto host = [](const std::string& copy, const std::string& more) {
        return "void run(float* a, int n) {\n  prepare(a, n);\n" + copy + more +
               "  for (int i = 0; i < n; ++i) {\n"
               "    a[i] = a[i] * 2.0f;\n  }\n  finish(a, n);\n}\n";
    };
    const std::string copy = "  cudaMemcpy(d, a, n, cudaMemcpyHostToDevice);\n",
                      update = "  #pragma omp target update to (a[0:n])\n";
    start("k.cu", host(copy, ""), "k.cpp", host(update, ""));
    expect_ported(host(copy, kStart), host(update, kStart));
}

TEST_F(SyncLaunch, NothingComesBetweenADirectiveAndItsLoop) {
    const auto host = [](const std::string& copy, const std::string& more) {
        return "void run(float* a, int n) {\n  prepare(a, n);\n" + copy + more +
               "  for (int i = 0; i < n; ++i) {\n"
               "    a[i] = a[i] * 2.0f;\n  }\n  finish(a, n);\n}\n";
    };
    start("k.cpp", host("", ""), "k_omp.cpp", host("  #pragma omp parallel for\n", ""));
    const nlohmann::json got = proposal_of(host("", kStart));
    if (got["patch"].is_string()) {
        EXPECT_LT(got["patch"].get<std::string>().find("start"), got["patch"].get<std::string>().find("#pragma"))
            << got.dump(1);
    }
}

TEST_F(SyncLaunch, WhatComesBehindALaunchStaysInTheBlockThatSetsItApart) {
    const auto port = [](const std::string& before, const std::string& behind) {
        return "void run(sycl::queue& q, float* a, int n) {\n  prepare(a, n);\n  {\n"
               "    sycl::buffer<float, 1> d_a(a, n);\n" +
               before +
               "    q.submit([&](sycl::handler& h) {\n"
               "      h.parallel_for(n, [=](sycl::item<1> i) {\n        work(a, n, i);\n      });\n    });\n" +
               behind + "  }\n  finish(a, n);\n}\n";
    };
    const std::string sync = "  cudaDeviceSynchronize();\n", wait = "    q.wait();\n";
    start("k.cu", cuda_run("", ""), "k.cpp", port("", wait));
    expect_ported(cuda_run(kStart, sync + kEnd), port(kStart, wait + kEnd));
}

TEST_F(SyncLaunch, AClockBehindWhatThePortWaitsForIsCarried) {
    start("k.cpp", omp_run("", ""), "k_sycl.cpp", sycl_run("", "", "  }).wait();\n"));
    expect_ported(omp_run("", "\n" + kEnd), sycl_run("", kEnd, "  }).wait();\n"));
}

TEST_F(SyncLaunch, HostCodeDoesNotComeIntoWhatTheDeviceRuns) {
    const auto host = [](const std::string& before) {
        return "void run(float* a, int n) {\n  prepare(a, n);\n  {\n" + before +
               "    work(a, n, 1);\n  }\n  finish(a, n);\n}\n";
    };
    start("k.cpp", host(""), "k_sycl.cpp",
          "void run(sycl::queue& q, float* a, int n) {\n  prepare(a, n);\n  q.submit([&](sycl::handler& h) {\n"
          "    h.parallel_for(n, [=](sycl::item<1> i) {\n      work(a, n, 1);\n    });\n  });\n  finish(a, n);\n}\n");
    write(source_path, host("  " + kStart));
    const nlohmann::json got = nlohmann::json::parse(porttool({"sync", "--format", "json"}).out)["proposals"][0];
    EXPECT_NE(got["state"], "proposed") << got.dump(1);
}

TEST_F(SyncLaunch, ABlockThatOnlySaysWhereDataIsNeedNotBeThere) {
    const auto host = [](const std::string& open, const std::string& before, const std::string& close) {
        return "void run(float* a, int n) {\n  prepare(a, n);\n" + open + before +
               "  for (int i = 0; i < n; ++i)\n    work(a, i);\n" + close + "  finish(a, n);\n}\n";
    };
    const std::string data = "  #pragma omp target data map(tofrom: a[0:n])\n  {\n";
    start("k.cpp", host(data, "", "  }\n"), "k_host.cpp", host("", "", ""));
    expect_ported(host(data, "  int done = 0;\n", "  }\n"), host("", "  int done = 0;\n", ""));
}

std::string launches(const std::string& run, const std::string& more) {
    return "#include <hip/hip_runtime.h>\nvoid run(float* a, int n) {\n  prepare(a, n);\n  " + run + more +
           "  finish(a, n);\n}\n";
}

TEST_F(SyncLaunch, ANewOneIsWrittenAsTheFileWritesItsOthers) {
    const std::string bracket = "work<<<n / 64, 64>>>(a, n);\n",
                      function = "hipLaunchKernelGGL(work, dim3(n / 64), dim3(64), 0, 0, a, n);\n";
    start("k.cu", launches(bracket, ""), "k.hip", launches(function, ""));
    expect_in_patch(launches(bracket, "  other<float><<<n / 32, 32, 16>>>(a);\n"),
                    "+  hipLaunchKernelGGL(HIP_KERNEL_NAME(other<float>), dim3(n / 32), dim3(32), 16, 0, a);");
    expect_ported(launches(bracket, "  again<<<n / 32, 32>>>(a, n, 2);\n"),
                  launches(function, "  hipLaunchKernelGGL(again, dim3(n / 32), dim3(32), 0, 0, a, n, 2);\n"));
}

TEST_F(SyncLaunch, TheOtherWayRoundIt) {
    const std::string bracket = "work<<<n / 64, 64>>>(a, n);\n",
                      function = "hipLaunchKernelGGL(work, n / 64, 64, 0, 0, a, n);\n";
    start("k.hip", launches(function, ""), "k.cu", launches(bracket, ""));
    expect_ported(launches(function, "  hipLaunchKernelGGL(again, n / 32, 32, 8, 0, a);\n"),
                  launches(bracket, "  again<<<n / 32, 32, 8>>>(a);\n"));
}

TEST_F(SyncLaunch, AFileThatHasBothWaysTellsNone) {
    const std::string bracket = "work<<<n / 64, 64>>>(a, n);\n",
                      both = "hipLaunchKernelGGL(work, n / 64, 64, 0, 0, a, n);\n  third<<<1, 1>>>(a);\n";
    start("k.cu", launches(bracket, "  third<<<1, 1>>>(a);\n"), "k.hip", launches(both, ""));
    expect_in_patch(launches(bracket, "  third<<<1, 1>>>(a);\n  again<<<n / 32, 32>>>(a, n, 2);\n"),
                    "again<<<n / 32, 32>>>");
}

TEST_F(SyncLaunch, HowAnExtentIsSaidIsNothingToAPortThatHasNone) {
    const auto hip = [](const std::string& extents, const std::string& count) {
        return launches("hipLaunchKernelGGL(work, " + extents + ", 0, 0, a, n);\n", "  check(a, " + count + ");\n");
    };
    const auto sycl = [](const std::string& count) {
        return replaced(sycl_run("", ""), "  finish", "  check(a, " + count + ");\n  finish");
    };
    start("k.hip", hip("dim3(n / 64), dim3(64)", "8"), "k.cpp", sycl("8"));
    expect_ported(hip("n / 64, 64", "16"), sycl("16"));
}

TEST_F(SyncLaunch, ABuiltInIsInTheScopeThatThePortHasAllOthersIn) {
    const auto gate = [](const std::string& head, const std::string& square_root, const std::string& value) {
        return head + "  float y = " + square_root + "(x);\n  return " + value + ";\n}\n";
    };
    const std::string cuda = "__device__ float gate(float x) {\n", sycl = "float gate(float x) {\n";
    const std::string host = "float other(float x) {\n  return exp(x);\n}\n";
    start("k.cu", gate(cuda, "sqrtf", "y"), "k.cpp", host + gate(sycl, "sycl::sqrt", "y"));
    expect_ported(gate(cuda, "sqrtf", "y * expf(x)"), host + gate(sycl, "sycl::sqrt", "y * sycl::exp(x)"));
}

TEST_F(SyncLaunch, ABuiltInHasNoScopeWhereOneOfThePortsHasNone) {
    const auto gate = [](const std::string& head, const std::string& square_root, const std::string& low,
                         const std::string& value) {
        return head + "  float y = " + square_root + "(x) + " + low + "(x);\n  return " + value + ";\n}\n";
    };
    const std::string cuda = "__device__ float gate(float x) {\n", sycl = "float gate(float x) {\n";
    const std::string host = "float other(float x) {\n  return exp(x);\n}\n";
    start("k.cu", gate(cuda, "sqrtf", "floorf", "y"), "k.cpp", host + gate(sycl, "sycl::sqrt", "floor", "y"));
    const nlohmann::json got = proposal_of(gate(cuda, "sqrtf", "floorf", "y * expf(x)"));
    EXPECT_EQ(got.dump().find("sycl::exp"), std::string::npos) << got.dump(1);
}

TEST_F(SyncLaunch, ANewParameterDoesNotBringThePortsOwnAgain) {
    const auto run = [](const std::string& parameters, const std::string& value) {
        return "void run(" + parameters + "const int repeat)\n{\n  int size = " + value +
               ";\n  step(size, repeat);\n}\n";
    };
    start("k.cu", run("", "1 << 8"), "k.cpp", run("sycl::queue& q, ", "1 << 8"));
    expect_ported(run("const int num, ", "1 << num"), run("sycl::queue& q, const int num, ", "1 << num"));
}

TEST_F(SyncLaunch, ATypeOfALibraryInAStructIsStillTheLibrarys) {
    const auto timer = [](const std::string& type, const std::string& now) {
        return "#include <chrono>\nstruct Timer {\n  " + type + " begin;\n  void start() {\n    begin = " + now +
               "();\n  }\n};\n";
    };
    const std::string was = timer("clock_t", "clock"),
                      is = timer("std::chrono::steady_clock::time_point", "std::chrono::steady_clock::now");
    start("timer.h", was, "timer_sycl.h", was);
    write(source_path, is);
    const nlohmann::json all = nlohmann::json::parse(porttool({"sync", "--all", "--format", "json"}).out)["proposals"];
    ASSERT_FALSE(all.empty());
    for (const nlohmann::json& one : all) EXPECT_TRUE(one["left"].empty()) << one.dump(1);
}

TEST_F(SyncLaunch, ATextThatNamesALibraryOfOneRuntimeIsLeft) {
    const auto run = [](const std::string& more) {
        return "void run(float* a, int n) {\n  prepare(a, n);\n" + more + "  finish(a, n);\n}\n";
    };
    start("k.cu", run(""), "k.cpp", run(""));
    expect_left(run("  printf(\"cublasSnrm2 took %d\\n\", n);\n"), "cublasSnrm2", 2);
    expect_ported(run("  printf(\"the cubic took %d\\n\", n);\n"), run("  printf(\"the cubic took %d\\n\", n);\n"));
}

std::string checked(const std::string& type, const std::string& own, const std::string& end) {
    return "static " + type + " place(Room* room, int n) {\n" + own + "  if (n > 4) {\n    fill(room, n);\n  }\n" +
           end + "}\n";
}

TEST_F(SyncLaunch, AReturnOfThePortsOwnGivesNothingWhereAValueIsDue) {
    const std::string own = "  if (room->view) {\n    return;\n  }\n";
    start("k.cu", checked("void", "", ""), "k.cpp", checked("void", own, ""));
    expect_left(checked("int", "", "  return 0;\n"), "gives nothing back", 3);
}

TEST_F(SyncLaunch, AReturnOfALambdaIsNotTheFunctions) {
    const std::string own = "  each(room, [=](int i) {\n    if (i > n) return;\n    touch(room, i);\n  });\n";
    start("k.cu", checked("void", "", ""), "k.cpp", checked("void", own, ""));
    expect_ported(checked("int", "", "  return 0;\n"), checked("int", own, "  return 0;\n"));
}

TEST_F(SyncLaunch, APortOfSeveralFollowsNoQualifiersOfOne) {
    const auto pass = [](const std::string& name, const std::string& pointer) {
        return "__global__ void " + name + "(const " + pointer + " in, " + pointer +
               " out, int n) {\n  int i = blockIdx.x * blockDim.x + threadIdx.x;\n  if (i < n) out[i] = in[i] * "
               "2.0f;\n}\n";
    };
    source_path = "src/k.cu", port_path = "port/k.cpp";
    write(source_path, pass("rows", "float*") + pass("columns", "float*"));
    write(
        port_path,
        "void filter(const float* in, float* out, int n) {\n  for (int i = 0; i < n; ++i) out[i] = in[i] * 2.0f;\n}\n");
    write("portmap.toml",
          "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n"
          "[[pair]]\nsource = \"src/k.cu:rows\"\ntarget = \"port/k.cpp:filter\"\n"
          "[[pair]]\nsource = \"src/k.cu:columns\"\ntarget = \"port/k.cpp:filter\"\n");
    ASSERT_EQ(porttool({"init"}).exit_code, 0);
    commit("in step");
    expect_already(pass("rows", "float* __restrict__") + pass("columns", "float* __restrict__"));
}

TEST_F(SyncLaunch, APortOfOneFollowsItsQualifiers) {
    const auto pass = [](const std::string& head, const std::string& pointer) {
        return head + "void rows(const " + pointer + " in, " + pointer +
               " out, int n) {\n  for (int i = 0; i < n; ++i) out[i] = in[i] * 2.0f;\n}\n";
    };
    start("k.cu", pass("__host__ ", "float*"), "k.cpp", pass("", "float*"));
    write(source_path, pass("__host__ ", "float* __restrict__"));
    const std::string asked = porttool({"sync", "src/k.cu:rows", "--format", "json"}).out;
    EXPECT_EQ(nlohmann::json::parse(asked)["proposals"][0]["state"], "proposed") << asked;
}

TEST_F(SyncLaunch, AnEmptyLinePartsWhatGoesWithEachNeighbour) {
    const auto run = [](const std::string& first, const std::string& own, const std::string& second) {
        return "int main(int argc, char** argv) {\n  int n = atoi(argv[1]);\n" + first + own + second +
               "  test(n);\n  return 0;\n}\n";
    };
    const std::string own = "\n  sycl::queue q(sycl::gpu_selector_v);\n\n";
    start("k.cu", run("", "", ""), "k.cpp", run("", own, ""));
    const std::string count = "  int count = atoi(argv[2]);\n", told = "  printf(\"begin\\n\");\n";
    expect_ported(run(count, "", "\n" + told), run(count, own, told));
}

TEST_F(SyncLaunch, AParenthesisThatThePortNeverHadNeedNotGo) {
    const auto gate = [](const std::string& head, const std::string& value) {
        return head + "  float m = s.top * x;\n  m = " + value + ";\n  return m;\n}\n";
    };
    const std::string cuda = "__device__ float gate(Set s, float x) {\n", cpp = "float gate(Set s, float x) {\n";
    start("k.cu", gate(cuda, "1.0f / (s.low)"), "k.cpp", gate(cpp, "1.0f / s.low"));
    expect_ported(gate(cuda, "s.top / s.low"), gate(cpp, "s.top / s.low"));
}

TEST_F(SyncLaunch, WhatPicksAMemberGoesWithWhatItIsPickedOf) {
    const auto fold = [](const std::string& head, const std::string& value) {
        return head + " {\n  float r = " + value + ";\n  return r * 2.0f;\n}\n";
    };
    const std::string cpp = "float fold(const Set* set, Extra& aux)",
                      cl = "float fold(__constant Set* set, Extra* aux)";
    start("k.cpp", fold(cpp, "floor(aux.low) - set->common.top"), "k.cl",
          fold(cl, "floor(aux->low) - set->common.top"));
    expect_ported(fold(cpp, "floor(set->common.low) - set->common.top"),
                  fold(cl, "floor(set->common.low) - set->common.top"));
}

std::string mixed(const std::string& parameters) { return "float mixed(" + parameters + ") {\n  return 1.0f;\n}\n"; }

TEST_F(SyncLaunch, ANewParameterDoesNotComeBehindAnother) {
    start("k.cu", mixed("const float coat, const float gloss, const float sheen, const float tint"), "k.cpp",
          mixed("const float tintVal, const float sheenVal, const float coatVal, const float glossVal"));
    write(source_path,
          mixed("const float coat, const float gloss, const float sheen, const float tint, const float thick"));
    const nlohmann::json got = nlohmann::json::parse(porttool({"sync", "--format", "json"}).out)["proposals"][0];
    if (got["patch"].is_string()) {
        EXPECT_EQ(got["patch"].get<std::string>().find("glossVal, const float thick"), std::string::npos)
            << got.dump(1);
    }
}

TEST_F(SyncLaunch, ANewParameterComesBehindItsOwnNeighbour) {
    start("k.cu", mixed("const float coat, const float tint"), "k.cpp",
          mixed("const float coatVal, const float tintVal"));
    expect_ported(mixed("const float coat, const float thick, const float tint"),
                  mixed("const float coatVal, const float thick, const float tintVal"));
}

TEST_F(SyncLaunch, WhatReadsTheDataDoesNotComeIntoTheBlockThatHasIt) {
    const auto port = [](const std::string& behind) {
        return "void run(sycl::queue& q, float* a, int n) {\n  prepare(n);\n  {\n"
               "    sycl::buffer<float, 1> d_a(a, n);\n"
               "    q.submit([&](sycl::handler& h) {\n"
               "      h.parallel_for(n, [=](sycl::item<1> i) {\n        work(a, n, i);\n      });\n    });\n"
               "    q.wait();\n" +
               behind + "  }\n  finish(n);\n}\n";
    };
    const auto host = [](const std::string& behind) {
        return "void run(float* a, int n) {\n  prepare(n);\n  work<<<n / 64, 64>>>(a, n);\n" + behind +
               "  finish(n);\n}\n";
    };
    start("k.cu", host(""), "k.cpp", port(""));
    expect_left(host("  cudaDeviceSynchronize();\n  tell(a);\n"), "block of its own", 9);
}

TEST_F(SyncLaunch, AClockThatBeginsATimeComesRightBeforeWhatTakesIt) {
    const auto host = [](const std::string& begin, const std::string& end) {
        return "void run(float* a, int n) {\n  prepare(a, n);\n" + begin +
               "  for (int i = 0; i < n; ++i)\n    work(a, i);\n" + end + "  finish(a, n);\n}\n";
    };
    const auto port = [](const std::string& begin, const std::string& end) {
        return "void run(float* a, int n) {\n  prepare(a, n);\n  #pragma omp target data map(tofrom: a[0:n])\n  {\n" +
               begin + "  for (int i = 0; i < n; ++i)\n    work(a, i);\n" + end + "  }\n  finish(a, n);\n}\n";
    };
    start("k.cu", host("", ""), "k.cpp", port("", ""));
    const std::string told = "  printf(\"%f\\n\", spent(start, end));\n";
    expect_ported(host(kStart, kEnd + told), port(kStart, kEnd + told));
}

TEST_F(SyncLaunch, AClockThatIsAskedAgainBehindTheBlockBeginsBeforeIt) {
    const auto host = [](const std::string& begin, const std::string& end) {
        return "void run(float* a, int n) {\n  prepare(a, n);\n" + begin +
               "  for (int i = 0; i < n; ++i)\n    work(a, i);\n  give(a, n);\n" + end + "  finish(a, n);\n}\n";
    };
    const auto port = [](const std::string& begin, const std::string& end) {
        return "void run(float* a, int n) {\n  prepare(a, n);\n" + begin +
               "  #pragma omp target data map(tofrom: a[0:n])\n  {\n"
               "  for (int i = 0; i < n; ++i)\n    work(a, i);\n  }\n  give(a, n);\n" +
               end + "  finish(a, n);\n}\n";
    };
    start("k.cu", host("", ""), "k.cpp", port("", ""));
    const std::string told = "  printf(\"%f\\n\", spent(start, end));\n";
    expect_ported(host(kStart, kEnd + told), port(kStart, kEnd + told));
}

TEST_F(SyncLaunch, AClockBehindACallThatThePortOnlyStartsWaitsForIt) {
    const std::string host =
        "void run(float* a, int n) {\n  prepare(a, n);\n  for (int i = 0; i < n; ++i)\n    work(a, n);\n";
    const std::string port =
        "void run(sycl::queue& q, float* a, int n) {\n  prepare(a, n);\n  for (int i = 0; i < n; ++i)\n"
        "    q.submit([&](sycl::handler& h) {\n      h.parallel_for(n, [=](sycl::item<1> j) {\n        step(a, j);\n"
        "      });\n    });\n";
    const std::string finish = "  finish(a, n);\n}\n";
    start("k.cpp", host + finish, "k_sycl.cpp", port + finish);
    expect_ported(host + kEnd + finish, port + "  q.wait();\n" + kEnd + finish);
}

TEST_F(SyncLaunch, ABranchBeforeTheLastElseIsOneMoreOfTheChain) {
    const auto chain = [](const std::string& name, const std::string& more) {
        return "void " + name +
               "(int n) {\n    if (n == 0) {\n        first(n);\n    } else if (n == 1) {\n        second(n);\n    }" +
               more + " else {\n        last(n);\n    }\n}\n";
    };
    start("k.cpp", chain("run", ""), "k.cu", chain("run", ""));
    const std::string more = " else if (n == 2) {\n        third(n);\n    }";
    expect_written(chain("run", more), chain("run", more));
}

TEST_F(SyncLaunch, ABranchWithinTheLastElseStaysWithinIt) {
    const auto chain = [](const std::string& last) {
        return "void run(int n) {\n    if (n == 0) {\n        first(n);\n    } else {\n" + last + "    }\n}\n";
    };
    start("k.cpp", chain("        last(n);\n"), "k.cu", chain("        last(n);\n"));
    const std::string within =
        chain("        if (n == 2) {\n            third(n);\n        } else {\n            last(n);\n        }\n");
    expect_ported(within, within);
}

}  // namespace sync_launch_test
}  // namespace porttool::testing
