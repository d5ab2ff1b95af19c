// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Edits of which the port owes nothing, beside each what it owes; and lines of what is left.
#include "tests/porttool/synced_repository.h"

namespace porttool::testing {
namespace sync_idle_test {

class SyncIdle : public SyncedRepository {
protected:
    void expect_already(const std::string& now) {
        const nlohmann::json got = proposal_of(now);
        EXPECT_EQ(got["state"], "already") << got.dump(1);
    }
    void expect_state(const std::string& now, const std::string& state) {
        const nlohmann::json got = proposal_of(now);
        EXPECT_EQ(got["state"], state) << got.dump(1);
    }
};

/// A kernel whose port takes functions from `scope`.
std::string wave(const std::string& head, const std::string& line) {
    return head + " {\n  float angle = x[i] * 0.5f;\n  float side = " + line + ";\n  y[i] = side * angle;\n}\n";
}
const std::string kWave = "__device__ void wave(const float* x, float* y, int i)";
const std::string kWavePort = "void wave(const float* x, float* y, int i)";

TEST_F(SyncIdle, AFunctionOfAScopeOfThePortsKeepsItsNameThere) {
    start("k.cu", wave(kWave, "sin(angle)"), "k.cpp", wave(kWavePort, "sycl::sin(angle)"));
    expect_already(wave(kWave, "sinf(angle)"));
    expect_ported(wave(kWave, "sinf(angle + 1.0f)"), wave(kWavePort, "sycl::sin(angle + 1.0f)"));
}

TEST_F(SyncIdle, ARealNumberIsNotGivenToAnotherFunctionThatTakesWholeOnes) {
    start("k.cu", wave(kWave, "pow(angle, 2)"), "k.cpp", wave(kWavePort, "sycl::pown(angle, 2)"));
    expect_left(wave(kWave, "pow(angle, 2.0)"), "pown", 3);
}

TEST_F(SyncIdle, ARealNumberIsGivenToTheSameFunction) {
    start("k.cu", wave(kWave, "pow(angle, 2)"), "k.cpp", wave(kWavePort, "sycl::pow(angle, 2)"));
    expect_ported(wave(kWave, "pow(angle, 2.0)"), wave(kWavePort, "sycl::pow(angle, 2.0)"));
}

std::string cuda_room(const std::string& declared, const std::string& check = "", const std::string& close = "") {
    return "void room(const float* x, int n) {\n" + declared + "  " + check + "cudaMalloc((void**)&a, n)" + close +
           ";\n  " + check + "cudaMalloc((void**)&b, n)" + close + ";\n  fill(a, b, x, n);\n  tell(n, 4);\n}\n";
}
const std::string kApart = "  float* a;\n  float* b;\n", kTogether = "  float *a, *b;\n";

std::string sycl_room(const std::string& told) {
    return "void room(sycl::queue& q, const float* x, int n) {\n  float* a = sycl::malloc_device<float>(n, q);\n"
           "  float* b = sycl::malloc_device<float>(n, q);\n  fill(a, b, x, n);\n  tell(n, " +
           told + ");\n}\n";
}

TEST_F(SyncIdle, NamesDeclaredTogetherAreNothingToAPortThatGivesEachItsValue) {
    start("k.cu", cuda_room(kApart), "k.cpp", sycl_room("4"));
    const nlohmann::json got = proposal_of(cuda_room(kTogether));
    EXPECT_TRUE(got["patch"].is_null()) << got.dump(1);
    const nlohmann::json more = proposal_of(replaced(cuda_room(kTogether), "tell(n, 4)", "tell(n, 5)"));
    ASSERT_TRUE(more["patch"].is_string()) << more.dump(1);
    const std::string patch = more["patch"].get<std::string>();
    EXPECT_EQ(patch.find("-  float"), std::string::npos) << patch;
    EXPECT_EQ(patch.find("+  float"), std::string::npos) << patch;
}

TEST_F(SyncIdle, NamesDeclaredTogetherAreSoInAPortThatDeclaresThemAlike) {
    const auto hip = [](std::string text) {
        for (size_t at = 0; (at = text.find("cuda", at)) != std::string::npos;) text.replace(at, 4, "hip");
        return text;
    };
    start("k.cu", cuda_room(kApart), "k.hip", hip(cuda_room(kApart)));
    const std::string now = replaced(cuda_room(kTogether), "tell(n, 4)", "tell(n, 5)");
    expect_ported(now, hip(now));
}

TEST_F(SyncIdle, WhatLooksAtAStatusIsNothingToAPortWithoutOne) {
    start("k.cu", cuda_room(kApart), "k.cpp", sycl_room("4"));
    expect_ported(replaced(cuda_room(kApart, "GPU_CHECK(", ")"), "tell(n, 4)", "tell(n, 5)"), sycl_room("5"));
}

TEST_F(SyncIdle, AMacroThatLooksAtAStatusNeedsNoPortWithoutOne) {
    const std::string check = "#define GPU_CHECK(call) do { if ((call) != 0) stop(__FILE__, __LINE__); } while (0)\n";
    start("k.cu", cuda_room(kApart), "k.cpp", sycl_room("4"));
    expect_ported(check + replaced(cuda_room(kApart, "GPU_CHECK(", ")"), "tell(n, 4)", "tell(n, 5)"), sycl_room("5"));
}

TEST_F(SyncIdle, WhatLooksAtAStatusComesToAPortWithOne) {
    const auto hip = [](std::string text) {
        for (size_t at = 0; (at = text.find("cuda", at)) != std::string::npos;) text.replace(at, 4, "hip");
        return text;
    };
    start("k.cu", cuda_room(kApart), "k.hip", hip(cuda_room(kApart)));
    const std::string now = replaced(cuda_room(kApart, "GPU_CHECK(", ")"), "tell(n, 4)", "tell(n, 5)");
    expect_ported(now, hip(now));
}

TEST_F(SyncIdle, HowAThreadSaysItsPlaceIsNoExampleOfMembers) {
    const auto cuda = [](const std::string& sum) {
        return "__device__ void sum(float2* v, int n) {\n  int lid = threadIdx.x;\n  int far = threadIdx.x + n;\n" +
               sum + "  v[lid] = v[lid] * 0.5f;\n}\n";
    };
    const auto sycl = [](const std::string& sum) {
        return "void sum(float2* v, int n, sycl::nd_item<1>& item) {\n  int lid = item.get_local_id(0);\n"
               "  int far = item.get_local_id(0) + n;\n" +
               sum + "  v[lid] = v[lid] * 0.5f;\n}\n";
    };
    start("k.cu", cuda("  v[lid] = v[lid] + v[far];\n"), "k.cpp", sycl("  v[lid] = v[lid] + v[far];\n"));
    const nlohmann::json got = proposal_of(cuda("  v[lid].x = v[lid].x + v[far].x;\n"));
    const std::string patch = got["patch"].is_string() ? got["patch"].get<std::string>() : "";
    EXPECT_EQ(patch.find("v[far].get_local_id"), std::string::npos) << got.dump(1);
}

// Lines of what is left.

const std::string kLong =
    "      float near = a[i];\n      float far = a[n - i - 1];\n      if (near > far) {\n"
    "        a[i] = far;\n        a[n - i - 1] = near;\n      }\n";

std::string omp_runs(const std::string& more) {
    return "void run(float* a, int n) {\n  prepare(a, n);\n  #pragma omp target teams distribute parallel for\n"
           "  for (int i = 0; i < n / 2; ++i) {\n" +
           kLong + "  }\n" + more + "  finish(a, n);\n}\n";
}

TEST_F(SyncIdle, WhatHostCodeDoesIsLeftBesideALaunchAndNotWithinIt) {
    const auto cuda = [](const std::string& more) {
        return "void run(float* a, int n) {\n  prepare(a, n);\n  work<<<n / 64, 64>>>(a, n);\n" + more +
               "  finish(a, n);\n}\n";
    };
    start("k.cu", cuda(""), "k.cpp", omp_runs("  near(a);\n"));
    const nlohmann::json got = proposal_of(cuda("  swap(near, far, a, n, i);\n"));
    ASSERT_FALSE(got["left"].empty()) << got.dump(1);
    EXPECT_GE(got["left"][0]["target_line"], 11) << got.dump(1);
}

TEST_F(SyncIdle, WhatIsPrintedAndThePortNeverPrintedIsPerhapsDue) {
    const auto cuda = [](const std::string& text, const std::string& rest) {
        return "int run(float* a, int n) {\n  prepare(a, n);\n  printf(\"" + text +
               "\", n);\n  sort(a, n);\n  finish(a, " + rest + ");\n  return n;\n}\n";
    };
    const std::string port =
        "int run(float* a, int n) {\n  prepare(a, n);\n  sort(a, n);\n  finish(a, width(n));\n  return n;\n}\n";
    start("k.cu", cuda("sorts %d", "2 * n"), "k.cpp", port);
    const nlohmann::json got = proposal_of(cuda("sorting %d", "3 * n"));
    ASSERT_FALSE(got["left"].empty()) << got.dump(1);
    for (const nlohmann::json& one : got["left"])
        EXPECT_EQ(one["message"].get<std::string>().find("printf"), std::string::npos) << got.dump(1);
    EXPECT_NE(got["why"].dump().find("perhaps"), std::string::npos) << got.dump(1);
}

TEST_F(SyncIdle, AUnitThatIsTooLongIsLeftWhereItsEditBegins) {
    const auto text = [](const std::string& factor) {
        std::string out = "float sum(const float* x) {\n  float y = 0.0f;\n";
        for (int i = 0; i < 700; ++i)
            out += "  y += x[" + std::to_string(i) + "] * " + (i == 400 ? factor : "2.0f") + ";\n";
        return out + "  return y;\n}\n";
    };
    start("k.cu", text("2.0f"), "k.cpp", "// A port.\n" + text("2.0f"));
    expect_left(text("3.0f"), "too long", 404);
}

}  // namespace sync_idle_test
}  // namespace porttool::testing
