// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Edits of one side that leave each value what it was, or that only drive the side's own device, each beside edits like
// it that do more.
#include "porttool/compare/same_anyway.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::same_anyway_test {
namespace {

const std::string kKernel =
    "__global__ void scale(float* y, const float* x, int n, float k) {\n"
    "  const int i = blockIdx.x * blockDim.x + threadIdx.x;\n  if (i < n) { y[i] = k * x[i] + 0.5f; }\n}\n";
const std::string kHost =
    "int run(State& state, const float& k, int n) {\n  float sum = 0.0f;\n  int left = n;\n  size_t rows = 0;\n"
    "  rows = state.rows();\n  state.prepare(left);\n"
    "  scale<<<n / 256, 256, 0>>>(state.out(), state.in(), n, k);\n"
    "  for (int i = 0; i < n; ++i) { sum += state.at(i); }\n  left = state.left(sum);\n"
    "#if CUDART_VERSION >= 10010\n  state.set(1);\n#else\n  state.set(2);\n#endif\n"
    "  State& other = const_cast<State&>(state.other);\n  other.note(sum);\n  return left;\n}\n";
const std::string kPort =
    "int run(State& state, const float& k, int n) {\n  float sum = 0.0f;\n  int left = n;\n"
    "  state.prepare(left);\n  for (int i = 0; i < n; ++i) { state.out()[i] = k * state.in()[i] + 0.5f; }\n"
    "  for (int i = 0; i < n; ++i) { sum += state.at(i); }\n  left = state.left(sum);\n  return left;\n}\n";

/// What is told of an edit of the side with the kernel, which is the source's or the port's; "" for nothing.
std::string level_of(const std::string& from, const std::string& to, Side edited) {
    const std::string device = kKernel + kHost;
    const bool is_source = edited == Side::Source;
    MemoryDisk disk;
    disk.files = {{is_source ? "/r/s/k.cu" : "/r/t/k.cu", device},
                  {is_source ? "/r/t/k.cpp" : "/r/s/k.cpp", kPort},
                  {"/r/portmap.toml", std::string("version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n") +
                                          "[[pair]]\nsource = \"s/k." + (is_source ? "cu" : "cpp") +
                                          ":run\"\ntarget = \"t/k." + (is_source ? "cpp" : "cu") + ":run\"\n"}};
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0) << to;
    disk.files[is_source ? "/r/s/k.cu" : "/r/t/k.cu"] = replaced(device, from, to);
    std::string out;
    const auto report = check(disk);
    for (const auto& finding : report["findings"]) {
        EXPECT_TRUE(out.empty()) << to << ": more than one finding";
        out = finding["level"];
    }
    return out;
}

bool is_loud(const std::string& level) { return level == "warning" || level == "error"; }

struct Row {
    std::string what, from, to;
};

const std::string kLaunch = "scale<<<n / 256, 256, 0>>>(state.out(), state.in(), n, k);";

const std::vector<Row> kQuiet = {
    {"a cast to what takes it", "left = state.left(sum);", "left = (int)state.left(sum);"},
    {"another", "left = state.left(sum);", "left = static_cast<int>(state.left(sum));"},
    {"of a sum", "rows = state.rows();", "rows = (size_t)(state.rows());"},
    {"to what is returned", "return left;", "return (int)left;"},
    {"by value", "const float& k", "float k"},
    {"a constant reference", "int n) {\n  float", "const int& n) {\n  float"},
    {"a literal's type", "for (int i = 0; i < n; ++i) { sum", "for (auto i = 0; i < n; ++i) { sum"},
    {"of a real number", "float sum = 0.0f;", "auto sum = 0.0f;"},
    {"what may be written", "const_cast<State&>(state.other)", "state.other"},
    {"a version", "CUDART_VERSION >= 10010", "CUDART_VERSION >= 11010"},
    {"another way to ask", "#if CUDART_VERSION >= 10010", "#if defined(CUDART_VERSION) && CUDART_VERSION >= 10010"},
    {"a check", kLaunch, kLaunch + "\n  CUDA_CHECK(cudaGetLastError());"},
    {"a wait", kLaunch, kLaunch + "\n  CUDA_CHECK(cudaDeviceSynchronize());"},
    {"a check of nothing of the device", "state.prepare(left);", "CHECK_RANGE(left, n, rows);\n  state.prepare(left);"},
    {"whose device", "state.prepare(left);", "cudaSetDevice(state.get_device());\n  state.prepare(left);"},
};

const std::vector<Row> kLoud = {
    {"a cast to another type", "left = state.left(sum);", "left = (short)state.left(sum);"},
    {"a cast of a part", "left = state.left(sum);", "left = (int)state.left(sum) + n;"},
    {"a cast of an operand", "sum += state.at(i);", "sum += (int)state.at(i);"},
    {"another value", "return left;", "return (int)rows;"},
    {"a reference that is written", "int n) {\n  float", "int& n) {\n  float"},
    {"another type by value", "const float& k", "int k"},
    {"a literal of another type", "for (int i = 0; i < n; ++i) { sum", "for (auto i = 0u; i < n; ++i) { sum"},
    {"a real literal for a whole one", "int left = n;", "auto left = 1.5;"},
    {"a literal of twice the size", "float sum = 0.0f;", "auto sum = 0.0;"},
    {"another object", "const_cast<State&>(state.other)", "state.third"},
    {"a switch of the project", "#if CUDART_VERSION >= 10010", "#if USE_FAST_PATH"},
    {"how many threads", "n / 256, 256, 0", "n / 128, 128, 0"},
    {"what is launched", kLaunch, "scale<<<n / 256, 256, 0>>>(state.in(), state.out(), n, k);"},
    {"a call beside a wait", kLaunch, kLaunch + "\n  cudaDeviceSynchronize(); state.prepare(n);"},
    {"data", kLaunch, kLaunch + "\n  cudaMemset(state.out(), 0, n * sizeof(float));"},
    {"a check that is reckoned with", kLaunch, kLaunch + "\n  left = check_bounds(left, n, 16);"},
    {"memory that is given back", kLaunch, kLaunch + "\n  state.drop(); CUDA_CHECK(cudaFree(state.spare));"},
    {"a checkpoint", kLaunch, kLaunch + "\n  CHECKPOINT(left, n, 16);"},
    {"a check of what it does", kLaunch, kLaunch + "\n  CHECK(state.advance(left, n));"},
};

/// Of the port alone.
const std::vector<Row> kOfThePort = {
    {"a stream", kLaunch,
     "cudaStream_t stream = at::cuda::getCurrentCUDAStream();\n"
     "  scale<<<n / 256, 256, 0, stream>>>(state.out(), state.in(), n, k);"},
    {"memory of a block", "256, 0>>>", "256, 256 * sizeof(float) + slack>>>"},
};

TEST(SameAnyway, EachBesideOneLikeItThatDoesMore) {
    for (const Row& row : kOfThePort) {
        EXPECT_FALSE(is_loud(level_of(row.from, row.to, Side::Target))) << row.what;
        EXPECT_TRUE(is_loud(level_of(row.from, row.to, Side::Source))) << row.what;
    }
    for (const Side side : kBothSides) {
        for (const Row& row : kQuiet) EXPECT_FALSE(is_loud(level_of(row.from, row.to, side))) << row.what;
        for (const Row& row : kLoud) EXPECT_TRUE(is_loud(level_of(row.from, row.to, side))) << row.what;
    }
}

TEST(SameAnyway, WhereBothSidesDriveADeviceTheOneOwesItsWaits) {
    const std::string wait = "scale<<<n / 256, 256, 0>>>(state.out(), state.in(), n, k);";
    MemoryDisk disk;
    disk.files = {{"/r/s/k.cu", kKernel + kHost},
                  {"/r/t/k.hip", kKernel + kHost},
                  {"/r/portmap.toml",
                   "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n"
                   "[[pair]]\nsource = \"s/k.cu:run\"\ntarget = \"t/k.hip:run\"\n"}};
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
    disk.files["/r/s/k.cu"] = kKernel + replaced(kHost, wait, wait + "\n  CUDA_CHECK(cudaDeviceSynchronize());");
    EXPECT_EQ(check(disk)["findings"][0]["level"], "error");
}

TEST(SameAnyway, NamesOfVersions) {
    for (const std::string_view name : {"__CUDA_ARCH__", "CUDART_VERSION", "TORCH_VERSION_MAJOR", "_MSC_VER"})
        EXPECT_TRUE(tells_a_version(name)) << name;
    for (const std::string_view name : {"VERSION", "USE_FAST_PATH", "CONVERSION", "kVERSION", "runtime_VERSION"})
        EXPECT_FALSE(tells_a_version(name)) << name;
}

/// Long edits of several ports of one folder whose sources nobody touched are told once; slips each for itself.
TEST(SameAnyway, WorkOnThePortsIsToldOnce) {
    const std::string work =
        "  table.fill(rows, columns, weights, offsets);\n  table.sort(rows, columns, order, most);\n";
    const std::string body = "  float v = x[i] * 0.5f + table.at(i) - bias;\n  y[i] = v > lim ? lim : v;\n";
    const auto texts = [&](const std::string& f, const std::string& g) {
        return "void f(float* y, const float* x, int i) {\n" + f + "}\nvoid g(float* y, const float* x, int i) {\n" +
               g + "  y[i] += bias;\n}\n";
    };
    const auto loud_after = [&](const std::string& f, const std::string& g, const std::string& reference) {
        MemoryDisk disk;
        disk.files = {{"/r/s/k.cu", texts(body, body)},
                      {"/r/t/k.cpp", texts(body, body)},
                      {"/r/portmap.toml", "version = 1\n[sides]\nreference = \"" + reference +
                                              "\"\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n"
                                              "[[pair]]\nsource = \"s/k.cu:f\"\ntarget = \"t/k.cpp:f\"\n"
                                              "[[pair]]\nsource = \"s/k.cu:g\"\ntarget = \"t/k.cpp:g\"\n"}};
        EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
        disk.files["/r/t/k.cpp"] = texts(f, g);
        size_t out = 0;
        const auto report = check(disk);
        for (const auto& finding : report["findings"]) out += finding["level"] != "note" ? 1 : 0;
        return out;
    };
    const std::string other =
        "  cache.load(pages, blocks, strides, shape);\n  cache.pin(pages, blocks, owner, ticks);\n";
    EXPECT_EQ(loud_after(work + body, other + body, "source"), 1u);
    EXPECT_EQ(loud_after(work + body, other + body, "target"), 2u) << "the port is what counts";
    EXPECT_EQ(loud_after(work + body, replaced(body, "0.5f", "0.25f"), "source"), 2u);
    EXPECT_EQ(loud_after(replaced(body, "lim : v", "v : lim"), replaced(body, "0.5f", "0.25f"), "source"), 2u);
}

}  // namespace
}  // namespace porttool::testing::same_anyway_test
