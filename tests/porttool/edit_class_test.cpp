// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The class of an edit, in several dialects; the expectations are what the languages say.
#include <gtest/gtest.h>

#include "porttool/compare/edits.h"
#include "porttool/scan/scan.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::edit_class_test {
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
        {"const dropped", {{"const Hit hit", "Hit hit"}}, ""}};
    for (const Dialects& dialect : dialects())
        for (const Row& row : rows) EXPECT_EQ(class_of(dialect, row.edits), row.expected) << row.what << dialect.suffix;
}

TEST(EditClass, OfWhatOnlyOneDialectHas) {
    const std::vector<std::pair<size_t, Row>> rows = {
        {0, {"launch bounds", {{"(128, 4)", "(256, 4)"}}, "constant"}},
        {0, {"restrict", {{"const T* __restrict__ values", "const T* values"}}, ""}},
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

/// What the fingerprints say of an edit of `f`, whose parameters are `int a, int b, int c, int n, int mode`.
struct BodyRow {
    std::string before, now;
};

Change change_of(const std::string& path, const std::string& head, const BodyRow& row) {
    const auto prints = [&](const std::string& body) {
        const ScannedFile file = scan_text(path, head + " {\n" + body + "\n}\n");
        EXPECT_FALSE(file.units.empty()) << body;
        return file.units.empty() ? Fingerprints() : unit_state(file, file.units.front()).prints;
    };
    return classify(prints(row.before), prints(row.now));
}

const std::vector<std::pair<std::string, std::string>> kHeads = {
    {"k.cpp", "void f(int a, int b, int c, int n, int mode)"},
    {"k.cu", "__global__ void f(int a, int b, int c, int n, int mode)"},
    {"k.cl", "__kernel void f(int a, int b, int c, int n, int mode)"},
    {"k.hlsl", "void f(int a, int b, int c, int n, int mode)"},
    {"k.comp", "void f(int a, in int b, int c, int n, int mode)"}};

void expect_change(const std::vector<BodyRow>& rows, bool semantic) {
    for (const auto& [path, head] : kHeads)
        for (const BodyRow& row : rows)
            EXPECT_EQ(change_of(path, head, row), semantic ? Change::Semantic : Change::Cosmetic)
                << path << ": " << row.before << " -> " << row.now;
}

TEST(EditClass, AnotherNameInAnExpressionIsNoRenaming) {
    expect_change({{"if (a > kLimitA) g();", "if (a > kLimitB) g();"},
                   {"if (a && geometryN) g();", "if (a && shadeN) g();"},
                   {"if (mode & FLAG_REFLECT) g();", "if (mode & FLAG_REFRACT) g();"},
                   {"if (a) h(); else if (c > gA) g();", "if (a) h(); else if (c > gB) g();"},
                   {"for (int i=0; i<4 && goA; ++i) g();", "for (int i=0; i<4 && goB; ++i) g();"},
                   {"for (int i=0; i * goA; ++i) g();", "for (int i=0; i * goB; ++i) g();"},
                   {"for (;a > gA;) g();", "for (;a > gB;) g();"},
                   {"for (gX & gA; a; ) g();", "for (gX & gB; a; ) g();"},
                   {"if (n && gA[2]) g();", "if (n && gB[2]) g();"},
                   {"if (a > b) g();", "if (a > c) g();"},
                   {"while (a * gA) g();", "while (a * gB) g();"},
                   {"while (gX & gA) g();", "while (gX & gB) g();"},
                   {"switch (a & gA) { default: g(); }", "switch (a & gB) { default: g(); }"},
                   {"if (a < gX > gA) g();", "if (a < gX > gB) g();"},
                   {"if (gX * gA == n) g();", "if (gX * gB == n) g();"},
                   {"do g(); while (a > gA);", "do g(); while (a > gB);"},
                   {"a * gA;", "a * gB;"},
                   {"gX & gA;", "gX & gB;"},
                   {"a & gA, gX;", "a & gB, gX;"},
                   {"float x = a < gX, y = 1; g(x, a > gA);", "float x = a < gX, y = 1; g(x, a > gB);"},
                   {"int x = h<gX, gA, gZ>(a); g(x);", "int x = h<gX, gB, gZ>(a); g(x);"},
                   {"float t[2] = {gX * gA, a}; g(t);", "float t[2] = {gX * gB, a}; g(t);"}},
                  true);
}

TEST(EditClass, TwoWordsOfWhichNoneIsATypeDeclareNothing) {
    expect_change({{"if (not visible(a)) g();", "if (not hidden(a)) g();"},
                   {"if (a or gB) g();", "if (a or gC) g();"},
                   {"if (a and gB) g();", "if (a and gC) g();"},
                   {"not gA;", "not gB;"},
                   {"g((unsigned char)a);", "g((unsigned short)a);"},
                   {"g((const int)a);", "g((const uint)a);"},
                   {"g(sizeof(struct Foo));", "g(sizeof(struct Bar));"},
                   {"g(sizeof(struct Foo), 1);", "g(sizeof(struct Bar), 1);"},
                   {"co_return foo(a);", "co_return bar(a);"},
                   {"co_await foo;", "co_await bar;"},
                   {"co_yield foo;", "co_yield bar;"},
                   {"LIKELY foo(a);", "LIKELY bar(a);"},
                   {"likely foo(a);", "likely bar(a);"},
                   {"if (LIKELY foo(a)) g();", "if (LIKELY bar(a)) g();"},
                   {"extern float gA; g(gA);", "extern float gB; g(gB);"},
                   {"float foo(int); g(foo(a));", "float bar(int); g(bar(a));"},
                   {"struct P { float x, y; }; g();", "struct P { float y, x; }; g();"},
                   {"return gA;", "return gB;"},
                   {"throw gA;", "throw gB;"},
                   {"goto gA;", "goto gB;"},
                   {"delete gA;", "delete gB;"}},
                  true);
}

TEST(EditClass, AnUnnamedParameterIsItsType) {
    for (const BodyRow& row : std::vector<BodyRow>{{"const Foo", "const Bar"},
                                                   {"const Foo*", "const Bar*"},
                                                   {"struct Foo", "struct Bar"},
                                                   {"ns::Foo", "ns::Bar"},
                                                   {"unsigned char", "unsigned short"},
                                                   {"Foo const", "Bar const"},
                                                   {"int x = ns::gA", "int x = ns::gB"}}) {
        const auto prints = [](const std::string& parameter) {
            const ScannedFile file = scan_text("k.cpp", "int f(" + parameter + ") { return 1; }");
            return unit_state(file, file.units.at(0)).prints;
        };
        EXPECT_EQ(classify(prints(row.before), prints(row.now)), Change::Semantic) << row.before;
    }
}

TEST(EditClass, ARenamedLocalIsCosmeticWhereverItIsDeclared) {
    expect_change({{"Foo x = g(); h(x);", "Foo y = g(); h(y);"},
                   {"Foo x; h(x);", "Foo y; h(y);"},
                   {"Foo x(1); h(x);", "Foo y(1); h(y);"},
                   {"const Foo* x = g(); h(x);", "const Foo* y = g(); h(y);"},
                   {"Foo* x = g(); h(x);", "Foo* y = g(); h(y);"},
                   {"float* x; h(x);", "float* y; h(y);"},
                   {"float half = g(); h(half);", "float y = g(); h(y);"},
                   {"unsigned long x = 1; h(x);", "unsigned long y = 1; h(y);"},
                   {"float4 x[2]; h(x);", "float4 y[2]; h(y);"},
                   {"int u = 1, x = h<3, 4>(u), v; h(x);", "int u = 1, y = h<3, 4>(u), v; h(y);"},
                   {"for (int x = 0; x < 3; ++x) g(x);", "for (int y = 0; y < 3; ++y) g(y);"},
                   {"for (int i = 0, x = 3; i < x; ++i) g();", "for (int i = 0, y = 3; i < y; ++i) g();"},
                   {"switch (n) { case 1: { int x = 1; h(x); } }", "switch (n) { case 1: { int y = 1; h(y); } }"},
                   {"switch (n) { case 1: int x = 1; h(x); }", "switch (n) { case 1: int y = 1; h(y); }"}},
                  false);
    const std::vector<BodyRow> rows = {
        {"if (Foo* x = g()) h(x);", "if (Foo* y = g()) h(y);"},
        {"while (auto x = g()) h(x);", "while (auto y = g()) h(y);"},
        {"if (auto x = g(); x > 1) h(x);", "if (auto y = g(); y > 1) h(y);"},
        {"std::vector<std::vector<int>> x; h(x);", "std::vector<std::vector<int>> y; h(y);"},
        {"vector<pair<int,int>> x(3); h(x);", "vector<pair<int,int>> y(3); h(y);"},
        {"auto [u, x] = g(); h(u, x);", "auto [u, y] = g(); h(u, y);"},
        {"const auto& [u, x] = g(); h(u, x);", "const auto& [u, y] = g(); h(u, y);"},
        {"for (const auto& x : g()) h(x);", "for (const auto& y : g()) h(y);"},
        {"for (Foo& x : g()) h(x);", "for (Foo& y : g()) h(y);"},
        {"for (auto& [u, x] : g()) h(x, u);", "for (auto& [u, y] : g()) h(y, u);"},
        {"try { g(); } catch (const E& x) { h(x); }", "try { g(); } catch (const E& y) { h(y); }"},
        {"decltype(a) x = 1; h(x);", "decltype(a) y = 1; h(y);"},
        {"g([&](const Foo& x) { h(x); });", "g([&](const Foo& y) { h(y); });"},
        {"auto k = [&](int u) { int x = u; return x; }; h(k);", "auto k = [&](int u) { int y = u; return y; }; h(k);"},
        {"int (*x)(int) = g; x(1);", "int (*y)(int) = g; y(1);"}};
    for (const BodyRow& row : rows)
        EXPECT_EQ(change_of("k.cpp", kHeads[0].second, row), Change::Cosmetic) << row.before;
    EXPECT_EQ(change_of("k.cpp", "void f(int (*x)(int), Foo* y)", {"x(1); y();", "x(1); y();"}), Change::None);
}

/// The class of the first finding after an edit of the source of a pair that was in step.
std::string class_after(const std::string& suffix, const std::string& text, const std::string& from,
                        const std::string& to) {
    MemoryDisk disk;
    disk.files = {{"/r/src/k" + suffix, text}, {"/r/port/k.cpp", text}};
    run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"});
    disk.files["/r/src/k" + suffix] = replaced(text, from, to);
    const auto report = check(disk);
    return report["findings"].empty() ? "" : report["findings"][0]["change"].get<std::string>();
}

TEST(EditClass, OfOneSidesEditInAHead) {
    const std::string kernel =
        "float f(float a, int mode) { float r = a; if (a > kLimitA) r = g(r); if (mode & FLAG_REFLECT) r = h(r); "
        "if (not visible(a)) r += k(r); return r; }";
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"kLimitA", "kLimitB"}, {"FLAG_REFLECT", "FLAG_REFRACT"}, {"visible", "hidden"}})
        for (const char* suffix : {".cu", ".cl", ".hlsl"})
            EXPECT_EQ(class_after(suffix, kernel, from, to), "semantic") << from << suffix;
}

TEST(EditClass, OfOneSidesEditBesideTheValue) {
    struct SideRow {
        std::string suffix, text, from, to, expected;
    };
    const std::string block = "layout(std140, binding = 0) uniform B { float x; float y; };\n";
    const std::vector<SideRow> rows = {
        {".cu", "const float N = 1.0f/2;", "1.0f", "1", "constant"},
        {".cu", "const float N = 2.0f;", "const float", "const double", "semantic"},
        {".cu", "struct alignas(16) X { float a; };", "16", "32", "constant"},
        {".cpp", "struct X : A { float a; };", ": A", ": B", "semantic"},
        {".cpp", "struct A {}; template <int N> struct T; template<> struct T<1> { float a; };", "T<1>", "T<2>", ""},
        {".comp", block, "std140", "std430", "semantic"},
        {".comp", block, "binding = 0", "binding = 1", "constant"}};
    for (const SideRow& row : rows) {
        if (row.expected.empty())
            EXPECT_NE(class_after(row.suffix, row.text, row.from, row.to), "") << row.text;
        else
            EXPECT_EQ(class_after(row.suffix, row.text, row.from, row.to), row.expected) << row.text;
    }
}

}  // namespace
}  // namespace porttool::testing::edit_class_test
