// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The class of an edit, in several dialects; the expectations are what the languages say.
#include <gtest/gtest.h>

#include "tests/porttool/run_command.h"

namespace porttool::testing {
namespace {

const std::string kCuda = R"~(#define BIAS 0.125f
#define SQR(x) ((x) * (x))
enum Mode { MODE_A, MODE_B = 4, MODE_C };
struct Hit { float t; float u, v; int prim; };
__constant__ float table[4] = {1.0f, 2.0f, 3.0f, 4.0f};
static const char* NAME = "shade kernel";
template <int N, typename T> __device__ T sum(const T* __restrict__ values, int stride = 1) {
    T total = 0;
    for (int i = 0; i < N; ++i) total += values[i * stride];
    return total;
}
__global__ void __launch_bounds__(128, 4) shade(const Hit* __restrict__ hits, float* out, unsigned int count, float shadeN, float geometryN) {
    unsigned int i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i >= count) return;
    const Hit hit = hits[i];
    float cosine = dot3(geometryN, hit.t);
    float x = 1.0f;
    {
        float x = hit.u * 2.0f;
        cosine += x;
    }
    // cosine = 0.0f;
    int index = (int)(hit.v * 4.0f);
    printf("value %d\n", index);
    out[i] = sum<4, float>(table) * cosine + x * BIAS + fminf(hit.u, hit.v) + pow_of(shadeN, 1.0f);
    switch (hit.prim) { case 0: out[i] += 1.0f; break; default: out[i] -= 1.0f; }
}
)~";

std::string with(std::string text, const std::vector<std::pair<std::string, std::string>>& edits) {
    for (const auto& [from, to] : edits) text = replaced(text, from, to);
    return text;
}

struct Dialects {
    std::string suffix, text;
};

/// The same kernel in other dialects.
std::vector<Dialects> dialects() {
    const std::string plain =
        with(kCuda, {{"template <int N, typename T> __device__ T sum(const T* __restrict__ values, int stride = 1) {",
                      "float sum(DATA values, int stride) {"},
                     {"T total", "float total"},
                     {"< N", "< 4"},
                     {"sum<4, float>(table)", "sum(table, 1)"}});
    const std::string head =
        "__global__ void __launch_bounds__(128, 4) shade(const Hit* __restrict__ hits, float* out,";
    const std::string index = "blockIdx.x * blockDim.x + threadIdx.x";
    return {
        {".cu", kCuda},
        {".cl",
         with(
             plain,
             {{"DATA", "__global const float* restrict"},
              {"__constant__ float", "__constant float"},
              {head,
               "__kernel __attribute__((reqd_work_group_size(64, 1, 1))) void shade(__global const Hit* restrict hits, "
               "__global float* out,"},
              {index, "get_global_id(0)"}})},
        {".hlsl",
         with(plain,
              {{"DATA", "StructuredBuffer<float>"},
               {"__constant__ float", "static const float"},
               {head,
                "[numthreads(64, 1, 1)]\nvoid shade(uint3 id : SV_DispatchThreadID, RWStructuredBuffer<Hit> hits, "
                "RWStructuredBuffer<float> out,"},
               {index, "id.x"}})},
        {".dp.cpp",
         with(kCuda,
              {{"__device__ ", ""},
               {"__constant__ ", "constexpr "},
               {head,
                "[[sycl::reqd_work_group_size(1, 1, 128)]] void shade(sycl::nd_item<1> item, const Hit* __restrict__ "
                "hits, float* out,"},
               {index, "item.get_global_id(0)"}})}};
}

/// The class of the first finding after the edits: "semantic", "constant", or "" if nothing is found.
std::string class_of(const Dialects& dialect, const std::vector<std::pair<std::string, std::string>>& edits) {
    MemoryDisk disk;
    const std::string file = "/r/src/k" + dialect.suffix;
    disk.files = {{file, dialect.text},
                  {"/r/port/k.cpp", replaced(kCuda, "__global__ void __launch_bounds__(128, 4)", "void")}};
    run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"});
    disk.files[file] = with(dialect.text, edits);
    const auto report = check(disk);
    for (const auto& finding : report["findings"])
        if (finding["rule"] != "dialect-hazard")
            return finding["change"].is_null() ? finding["rule"] : finding["change"];
    return "";
}

struct Row {
    std::string what;
    std::vector<std::pair<std::string, std::string>> edits;
    std::string expected;
};

TEST(EditClass, OfTheSameEditInFourDialects) {
    const std::vector<Row> rows = {
        {"geometryN->shadeN", {{"geometryN, hit.t", "shadeN, hit.t"}}, "semantic"},
        {"swap args", {{"fminf(hit.u, hit.v)", "fminf(hit.v, hit.u)"}}, "semantic"},
        {"shadow renamed", {{"float x = hit.u", "float y = hit.u"}, {"cosine += x;", "cosine += y;"}}, ""},
        {"shadow inner renamed wrongly", {{"cosine += x;", "cosine += cosine;"}}, "semantic"},
        {"shadow decl renamed only", {{"float x = hit.u", "float y = hit.u"}}, "semantic"},
        {"macro value", {{"BIAS 0.125f", "BIAS 0.25f"}}, "constant"},
        {"macro body", {{"((x) * (x))", "((x) + (x))"}}, "semantic"},
        {"struct order", {{"float t; float u, v; int prim;", "float u, v; float t; int prim;"}}, "semantic"},
        {"enum value", {{"MODE_B = 4", "MODE_B = 5"}}, "constant"},
        {"comment code", {{"// cosine = 0.0f;", "cosine = 0.0f;"}}, "semantic"},
        {"code comment", {{"cosine += x;", "// cosine += x;"}}, "semantic"},
        {"string", {{"\"value %d", "\"Value %d"}}, "semantic"},
        {"global string", {{"\"shade kernel\"", "\"other kernel\""}}, "semantic"},
        {"<=", {{"i >= count", "i > count"}}, "semantic"},
        {"unsigned to int", {{"unsigned int i =", "int i ="}}, "semantic"},
        {"1.0f->1.0", {{"float x = 1.0f", "float x = 1.0"}}, "constant"},
        {"table", {{"2.0f, 3.0f", "3.0f, 2.0f"}}, "constant"},
        {"case label", {{"case 0:", "case 1:"}}, "constant"},
        {"break gone", {{"+= 1.0f; break;", "+= 1.0f;"}}, "semantic"},
        {"cast", {{"(int)(hit.v", "(unsigned)(hit.v"}}, "semantic"},
        {"member", {{"hit.u * 2.0f", "hit.v * 2.0f"}}, "semantic"},
        {"param swap", {{"float shadeN, float geometryN", "float geometryN, float shadeN"}}, "semantic"},
        {"param rename", {{"unsigned int count,", "unsigned int n,"}, {">= count", ">= n"}}, ""},
        {"const dropped", {{"const Hit hit", "Hit hit"}}, "semantic"}};
    for (const Dialects& dialect : dialects())
        for (const Row& row : rows) EXPECT_EQ(class_of(dialect, row.edits), row.expected) << row.what << dialect.suffix;
}

TEST(EditClass, OfWhatOnlyOneDialectHas) {
    const std::vector<std::pair<size_t, Row>> rows = {
        {0, {"launch bounds", {{"(128, 4)", "(256, 4)"}}, "constant"}},
        {0, {"restrict", {{"const T* __restrict__ values", "const T* values"}}, "semantic"}},
        {0, {"default arg", {{"stride = 1", "stride = 2"}}, "constant"}},
        {0, {"template arg", {{"sum<4, float>", "sum<3, float>"}}, "constant"}},
        {0, {"template type arg", {{"sum<4, float>", "sum<4, double>"}}, "semantic"}},
        {2, {"numthreads", {{"numthreads(64", "numthreads(32"}}, "constant"}},
        {1, {"reqd wgs", {{"reqd_work_group_size(64", "reqd_work_group_size(32"}}, "constant"}},
        {3, {"sycl attr", {{"reqd_work_group_size(1, 1, 128", "reqd_work_group_size(1, 1, 64"}}, "constant"}},
        {2, {"semantic", {{"SV_DispatchThreadID", "SV_GroupThreadID"}}, "semantic"}}};
    const auto all = dialects();
    for (const auto& [dialect, row] : rows) EXPECT_EQ(class_of(all[dialect], row.edits), row.expected) << row.what;
}

}  // namespace
}  // namespace porttool::testing
