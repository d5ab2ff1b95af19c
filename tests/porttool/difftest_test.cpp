// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Functions of both sides, built and run: what differs is found with an input that a reader can check by hand, what
// cannot run says why, and what would harm does not.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "porttool/difftest/bounded_process.h"
#include "porttool/difftest/build_defines.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

class Difftest : public TemporaryRepository {
protected:
    void SetUp() override {
        TemporaryRepository::SetUp();
        if (program_path("g++").empty() && program_path("clang++").empty()) GTEST_SKIP() << "no compiler is installed";
    }
    /// Both sides, each one file; the pairs by the names of the functions.
    nlohmann::json run_on(const std::string& source_name, const std::string& source, const std::string& target_name,
                          const std::string& target, std::vector<std::string> more = {}) {
        write("a/" + source_name, source);
        write("b/" + target_name, target);
        std::vector<std::string> arguments = {"difftest", "--source", "a/*", "--target", "b/*", "--format", "json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CommandRun got = porttool(arguments);
        EXPECT_NE(got.out, "") << got.err;
        exit_code = got.exit_code;
        return got.out.empty() ? nlohmann::json() : nlohmann::json::parse(got.out)["pairs"];
    }
    static nlohmann::json pair_of(const nlohmann::json& pairs, const std::string& name) {
        for (const auto& pair : pairs)
            if (pair["source"].get<std::string>().ends_with(":" + name)) return pair;
        ADD_FAILURE() << "no pair " << name << " in " << pairs.dump(1);
        return {};
    }
    int exit_code = -1;
};

constexpr const char* kGlsl = R"(#ifndef A
#define A
const float LIMIT = 0.25;
struct Ray { vec3 origin; vec3 direction; float reach; };
float weight(float cosine) { float m = 1.0 - clamp(cosine, 0.0, 1.0); return m * m; }
float lowered(float x) { return x > LIMIT ? x * 0.5 : x; }
vec3 swap_axes(vec3 v) { vec3 w; w.xy = v.yx; w.z = v.z; return w * 2.0; }
void split(in float x, out float whole, inout float rest) { whole = floor(x); rest += x - whole; }
float along(Ray ray, float t) { return dot(ray.origin + ray.direction * t, vec3(1.0, 0.0, 0.0)) + ray.reach; }
uint scramble(uint x) { x ^= x >> 16; x *= 0x7feb352du; return x; }
uniform Settings { float gain; } settings;
float gained(float x) { return x * settings.gain; }
float distant(float x) { return helper_elsewhere(x); }
float broken(float x) { return x + ; }
#endif
)";
constexpr const char* kCpp = R"(#include <cmath>
namespace port {
constexpr float kLimit = 0.25f;
struct Vector { float x, y, z; };
inline Vector operator*(Vector v, float s) { return {v.x * s, v.y * s, v.z * s}; }
struct Ray { Vector direction, origin; float reach; };
inline float weight(float cosine) { const float m = 1.0f - std::fmin(cosine, 1.0f); return m * m; }
inline float lowered(float x) { return x > kLimit ? x * 0.5f : x; }
inline Vector swap_axes(const Vector& v) { return Vector{v.y, v.x, v.z} * 2.0f; }
inline void split(float x, float* whole, float& rest) { *whole = std::floor(x); rest += x - *whole; }
static float first(const Ray& ray, float t) { return ray.origin.x + ray.direction.x * t; }
inline float along(const Ray& ray, float t) { return first(ray, t) + ray.reach; }
inline unsigned scramble(unsigned x) { x ^= x >> 16; x *= 0x7feb352du; return x; }
float gain = 1;
inline float gained(float x) { return x * gain; }
inline float distant(float x) { return x; }
inline float broken(float x) { return x; }
}
)";

TEST_F(Difftest, TellsWhatDiffersAndWhatCannotRun) {
    const nlohmann::json pairs = run_on("a.glsl", kGlsl, "b.h", kCpp,
                                        {"--inputs", "3000", "--ulps", "0", "--evidence", (root / "e.json").string()});
    EXPECT_EQ(exit_code, 1);
    // Below 0 the port lets the weight grow: (1 - c) squared in place of 1.
    const nlohmann::json weight = pair_of(pairs, "weight");
    ASSERT_EQ(weight["state"], "differs") << weight.dump(1);
    const nlohmann::json& example = weight["counterexample"];
    const double cosine = example["inputs"]["cosine"].get<double>();
    EXPECT_LT(cosine, 0);
    EXPECT_EQ(example["source"].get<double>(), 1);
    const float m = 1.0f - static_cast<float>(cosine);
    EXPECT_EQ(example["target"].get<double>(), static_cast<double>(m * m));
    EXPECT_EQ(cosine, -1) << "the simplest input";
    for (const char* name : {"lowered", "swap_axes", "split", "along", "scramble"}) {
        const nlohmann::json pair = pair_of(pairs, name);
        EXPECT_EQ(pair["state"], "same") << pair.dump(1);
        EXPECT_EQ(pair["tolerance"], "bits") << pair.dump(1);
        EXPECT_GT(pair["inputs"].get<int>(), 2500) << pair.dump(1);
    }
    EXPECT_EQ(pair_of(pairs, "gained")["reason"], "binding settings: a type that no run can make");
    EXPECT_EQ(pair_of(pairs, "distant")["reason"], "source: unknown helper helper_elsewhere");
    EXPECT_EQ(pair_of(pairs, "broken")["reason"].get<std::string>().find("source: does not compile as C++: "), 0u)
        << "the others ran all the same: " << pair_of(pairs, "broken");
    const nlohmann::json evidence = nlohmann::json::parse(read_text(root / "e.json"));
    EXPECT_EQ(evidence["pairs"], pairs);
    ASSERT_EQ(evidence["texts"].size(), 2u);
    EXPECT_EQ(evidence["texts"][0]["file"], "a/a.glsl");
}

TEST_F(Difftest, RecordsThatAPairRanTheSame) {
    write("a/a.glsl", "float half_of(float x) { return x * 0.5; }\nfloat twice(float x) { return x * 2.0; }\n");
    write("b/b.h",
          "inline float half_of(float x) { return x / 2; }\ninline float twice(float x) { return x * 3.0f; }\n");
    porttool({"init", "--source", "a/*", "--target", "b/*"});
    const std::string before = read_text(root / "portmap.lock");
    EXPECT_EQ(
        porttool({"difftest", "--inputs", "200", "--ulps", "0", "--evidence", (root / "e.json").string()}).exit_code,
        1);
    EXPECT_EQ(read_text(root / "portmap.lock"), before) << "it writes nothing unless asked";
    const nlohmann::json checked =
        nlohmann::json::parse(porttool({"check", "--format", "json", "--evidence", (root / "e.json").string()}).out);
    EXPECT_EQ(checked["findings"].size(), 1u) << "recorded as in step, and different when run";
    EXPECT_EQ(checked["findings"][0]["rule"], "unexplained-difference");
    EXPECT_EQ(checked["findings"][0]["source"]["id"], "a/a.glsl:twice");
    EXPECT_EQ(checked["summary"]["verified"], 1);
    const CommandRun got = porttool({"difftest", "a/a.glsl:half_of", "--inputs", "200", "--ulps", "0", "--record"});
    EXPECT_NE(got.out.find("1 pairs recorded as verified"), std::string::npos) << got.out << got.err;
    const std::string after = read_text(root / "portmap.lock");
    EXPECT_NE(after.find("difftest 2"), std::string::npos);
    EXPECT_EQ(std::count(after.begin(), after.end(), '\n'), std::count(before.begin(), before.end(), '\n'));
    EXPECT_EQ(nlohmann::json::parse(porttool({"check", "--format", "json"}).out)["summary"]["verified"], 1);
    EXPECT_EQ(porttool({"difftest", "--record", "--source", "a/*", "--target", "b/*"}).exit_code, 2);
}

TEST_F(Difftest, WhatIsNoMacroIsNamed) {
    write("a/a.glsl", "float half_of(float x) { return x * 0.5; }\n");
    write("b/b.h", "inline float half_of(float x) { return x / 2; }\n");
    for (const std::string odd : {"", "1A=2", "A B", "=3", "A=$(B)", "A=1;B", "A=<b>", "A-B=1", "A=\"b"}) {
        const CommandRun got = porttool({"difftest", "--source", "a/*", "--target", "b/*", "--define", odd});
        EXPECT_EQ(got.exit_code, 2) << odd;
        EXPECT_EQ(got.out, "") << odd;
        EXPECT_EQ(got.err.find("porttool: --define " + odd), 0u) << got.err;
    }
    porttool({"init", "--source", "a/*", "--target", "b/*"});
    write("portmap.toml", read_text(root / "portmap.toml") + "\n[difftest]\ndefines = [\"2X\"]\n");
    const CommandRun got = porttool({"difftest"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("[difftest] defines: 2X"), std::string::npos) << got.err;
}

TEST_F(Difftest, TakesKernelLanguagesForCpp) {
    write("inc/steps.h", "#define STEP(x, n) { x = turned_by (x, n); x += 1; }\n");
    write("inc/common.cl", "uint turned_by(const uint x, const int n) { return x << n | x >> (32 - n); }\n");
    const nlohmann::json pairs = run_on("a.cl", R"(#include "../inc/steps.h"
#include "../inc/common.cl"
uint stepped(uint x) { STEP(x, 3); return x; }
typedef struct { float3 base; float2 uv; int kind; } Hit;
__constant float kGains[3] = {0.5f, 1.0f, 2.0f};
float tone(const float3 c) { return mad(c.x, 0.25f, native_sqrt(fabs(c.s1))) + as_float(as_uint(c.z)); }
float3 shaded(__private const Hit *hit) { return (float3)(hit->uv.x, hit->uv.y, kGains[1]) * hit->base.zyx; }
int picked(int kind, bool front) { return select(kind, -kind, front); }
float named(float in, __private float *out) { *out = in + 1.0f; return in; }
float whole_power(float x) { return pown(x, 3); }
float sum(__global const float *values, int count) { float s = 0; for (int i = 0; i < count; ++i) s += values[i]; return s; }
__kernel void fill(__global float *out) { out[get_global_id(0)] = 1.0f; }
)",
                                        "b.cu", R"(
__device__ unsigned stepped(unsigned x) { return (x << 3 | x >> 29) + 1; }
struct Hit { float3 base; float2 uv; int kind; };
__constant__ float gains[3] = {0.5f, 1.0f, 2.0f};
__device__ __forceinline__ float tone(float3 c) { return c.x * 0.25f + sqrtf(fabsf(c.y)) + __uint_as_float(__float_as_uint(c.z)); }
__device__ float3 shaded(const Hit* __restrict__ hit) {
    float3 c = make_float3(hit->uv.x, hit->uv.y, gains[1]);
    return make_float3(c.x * hit->base.z, c.y * hit->base.y, c.z * hit->base.x);
}
__device__ float named(float in, float* out) { *out = 1.0f + in; return in; }
__device__ float whole_power(float x) { return powf(x, 3.0f); }
__device__ int picked(int kind, bool front) { return front ? kind : -kind; }
__device__ float sum(const float* values, int count) { float s = 0; for (int i = 0; i < count; ++i) s += values[i]; return s; }
__global__ void fill(float* out) { out[threadIdx.x] = 1.0f; }
)",
                                        {"--inputs", "3000", "--ulps", "0"});
    EXPECT_EQ(pair_of(pairs, "tone")["state"], "same") << pairs.dump(1);
    EXPECT_EQ(pair_of(pairs, "shaded")["state"], "same") << pairs.dump(1);
    EXPECT_EQ(pair_of(pairs, "stepped")["state"], "same") << "a macro's names are those of its user: " << pairs.dump(1);
    EXPECT_EQ(pair_of(pairs, "named")["state"], "same") << "`in` and `out` are names in OpenCL: " << pairs.dump(1);
    EXPECT_EQ(pair_of(pairs, "whole_power")["state"], "same") << pairs.dump(1);
    EXPECT_EQ(pair_of(pairs, "picked")["state"], "differs");
    EXPECT_EQ(pair_of(pairs, "picked")["counterexample"]["inputs"]["kind"], 1);
    EXPECT_EQ(pair_of(pairs, "sum")["reason"], "arrays of 64 elements");
    EXPECT_EQ(pair_of(pairs, "fill")["reason"], "a kernel: it takes its work from a launch");
}

TEST_F(Difftest, HasBuiltInsOfDevices) {
    // By their definitions, bit by bit.
    const std::string slow = R"(
int dotted(int a, int b, int c) { for (int i = 0; i < 4; ++i) c += (int)(signed char)(a >> 8 * i) * (signed char)(b >> 8 * i); return c; }
unsigned chosen(unsigned a, unsigned b, unsigned s) { unsigned out = 0; for (int i = 0; i < 4; ++i) {
    const unsigned digit = s >> 4 * i & 15, from = (digit & 4 ? b : a) >> 8 * (digit & 3) & 255;
    out |= (digit & 8 ? (from >> 7) * 255 : from) << 8 * i; } return out; }
)";
    const nlohmann::json pairs = run_on("a.cu", R"(
__device__ int dotted(int a, int b, int c) { return __dp4a(a, b, c); }
__device__ unsigned chosen(unsigned a, unsigned b, unsigned s) { return __byte_perm(a, b, s); }
)",
                                        "b.cpp", slow, {"--inputs", "2000", "--ulps", "0"});
    for (const char* name : {"dotted", "chosen"})
        EXPECT_EQ(pair_of(pairs, name)["state"], "same") << pair_of(pairs, name).dump(1);
}

TEST_F(Difftest, SuppliesWhatARunDoesNotHave) {
    const char* const source = R"(
struct Frame { float gain; uint count; };
layout(push_constant) uniform FrameBlock { Frame frame; };
layout(binding = 0) buffer Rows { vec4 rows[]; };
vec4 row_at(uint i) { return rows[i]; }
void put_row(uint i, vec4 row) { rows[i] = row; }
float gained(float x) { return x * frame.gain; }
float summed(uint i) { vec4 r = row_at(i); return r.x + r.y; }
void stored(uint i, float x) { put_row(i + frame.count, vec4(x, x * 2.0, 0.0, 1.0)); }
)";
    const std::string target = R"(
struct float4 { float x, y, z, w; };
struct Frame { unsigned count; float gain; };
static float4* rows;
static Frame frame;
inline float4 row_at(unsigned i) { return rows[i]; }
inline void put_row(unsigned i, float4 row) { rows[i] = row; }
inline float gained(float x) { return x * frame.gain; }
inline float summed(unsigned i) { const float4 r = row_at(i); return r.x + r.y; }
inline void stored(unsigned i, float x) { put_row(i + frame.count, float4{x, x * 2.0f, 0.0f, 1.0f}); }
)";
    nlohmann::json pairs = run_on("a.glsl", source, "b.h", target, {"--inputs", "2000", "--ulps", "0"});
    for (const char* name : {"gained", "summed", "stored"})
        EXPECT_EQ(pair_of(pairs, name)["state"], "same") << pairs.dump(1);
    for (const char* name : {"row_at", "put_row"}) {
        EXPECT_EQ(pair_of(pairs, name)["state"], "same") << pairs.dump(1);
        EXPECT_NE(pair_of(pairs, name)["reason"].get<std::string>().find("arrays of"), std::string::npos);
    }
    pairs =
        run_on("a.glsl", source, "b.h", replaced(replaced(target, "x * 2.0f", "x * 3.0f"), "r.x + r.y", "r.x - r.y"),
               {"--inputs", "2000", "--ulps", "0"});
    for (const char* name : {"summed", "stored"}) EXPECT_EQ(pair_of(pairs, name)["state"], "differs") << pairs.dump(1);
    EXPECT_EQ(pair_of(pairs, "stored")["counterexample"]["inputs"]["x"], 1);
}

// Tables and counters of a file: what a function reads in them is drawn, what it leaves there is compared.
TEST_F(Difftest, RunsWhatReadsAndWritesVariablesOfTheFile) {
    const std::string source = R"(#include <csetjmp>
#include <cstdlib>
#define WIDTH 3
typedef struct { float at; int hits; } Cell;
static unsigned int calls = 1, last[WIDTH], limit = 4;
float weights[WIDTH][2];
Cell *cells;
float** tables;
static int lonely = 2;
jmp_buf restart;
float weighed(int i, float x) { return i >= 0 && i < WIDTH ? weights[i][1] * x : 0.0f; }
float unweighed(int i, float x) { return i >= 0 && i < WIDTH ? weights[i][1] * x : 0.0f; }
void hit(int i) { cells[i].hits += 2; }
void hit_more(int i) { cells[i].hits += 2; }
void count(int by) { calls += by; last[1] = calls; }
void count_there(int by) { calls += by; last[1] = calls; }
int limited(int x) { return x > limit ? limit : x; }
int limited_less(int x) { return x > limit ? limit : x; }
void reset(void) { limit = 4; }
void reset_more(void) { limit = 4; }
int checked(int x) { if (x < 0) exit(2); if (x > 100) longjmp(restart, 1); return x * 3; }
float table_at(int i) { return tables[0][i]; }
int one_sided(int x) { return x + lonely++; }
)";
    std::string target = replaced(source, "static int lonely = 2;", "static int alone = 2;");
    for (const auto& [from, to] : std::initializer_list<std::pair<std::string, std::string>>{
             {"float unweighed(int i, float x) { return i >= 0 && i < WIDTH ? weights[i][1]",
              "float unweighed(int i, float x) { return i >= 0 && i < WIDTH ? weights[i][0]"},
             {"hit_more(int i) { cells[i].hits += 2", "hit_more(int i) { cells[i].hits += 3"},
             {"count_there(int by) { calls += by; last[1]", "count_there(int by) { calls += by; last[2]"},
             {"limited_less(int x) { return x > limit", "limited_less(int x) { return x >= limit - 1"},
             {"reset_more(void) { limit = 4", "reset_more(void) { limit = 5"},
             {"lonely++", "alone++"}})
        target = replaced(target, from, to);
    const nlohmann::json pairs = run_on("a.cu", source, "b.cpp", target, {"--inputs", "2000", "--ulps", "0"});
    for (const char* name : {"weighed", "hit", "count", "limited", "reset", "checked"})
        EXPECT_EQ(pair_of(pairs, name)["state"], "same") << pair_of(pairs, name).dump(1);
    for (const char* name : {"unweighed", "hit_more", "count_there", "limited_less", "reset_more"})
        EXPECT_EQ(pair_of(pairs, name)["state"], "differs") << pair_of(pairs, name).dump(1);
    EXPECT_LT(pair_of(pairs, "checked")["inputs"].get<int>(), 1800) << "who leaves the program gives no answer";
    EXPECT_EQ(pair_of(pairs, "table_at")["reason"], "binding tables: a type that no run can make");
    EXPECT_EQ(pair_of(pairs, "one_sided")["reason"], "binding lonely: the other side has none like it");
}

// A loop over what a binding holds ends by an entry that says that there is no more.
TEST_F(Difftest, AnswersOftenSayThatThereIsNothing) {
    const char* const source = R"(
layout(binding = 0) buffer Rows { uvec4 rows[]; };
uvec4 entry_at(uint i) { return rows[i]; }
uint find_entry(uint key) {
    uint place = key;
    while (entry_at(place).x != 0xffffffffu && entry_at(place).x != key) place = place + 1u;
    return place;
}
)";
    const std::string target = R"(
struct uint4 { unsigned x, y, z, w; };
struct Bound { const uint4* rows; };
extern Bound bound;
inline uint4 entry_at(unsigned i) { return bound.rows[i]; }
inline unsigned find_entry(unsigned key) {
    unsigned place = key;
    while (entry_at(place).x != 0xffffffffu && entry_at(place).x != key) place = place + 1u;
    return place;
}
)";
    const nlohmann::json pairs = run_on("a.glsl", source, "b.h", target, {"--inputs", "1000", "--ulps", "0"});
    EXPECT_EQ(pair_of(pairs, "find_entry")["state"], "same") << pairs.dump(1);
    EXPECT_GT(pair_of(pairs, "find_entry")["inputs"].get<int>(), 900);
}

TEST_F(Difftest, TellsRoundingFromADifference) {
    if (kSanitized) GTEST_SKIP() << "what runs here is not what is sanitized";
    const nlohmann::json pairs = run_on("a.cu", R"(
__device__ float between(float a, float b, float t) { return a + (b - a) * t; }
__device__ float poly(float x) { return ((0.3f * x + 0.7f) * x - 1.1f) * x + 0.1f; }
__device__ float near_half(float x) { return x * 0.5f; }
__device__ float clocked(float x) { return x + (float)clock(); }
)",
                                        "b.cpp", R"(
#include <ctime>
float between(float a, float b, float t) { return (1.0f - t) * a + t * b; }
float poly(float x) { return 0.3f * x * x * x + 0.7f * x * x - 1.1f * x + 0.1f; }
float near_half(float x) { return x * 0.50001f; }
float clocked(float x) { return x + (float)clock(); }
)",
                                        {"--inputs", "5000"});
    EXPECT_EQ(pair_of(pairs, "poly")["state"], "same") << pairs.dump(1);
    EXPECT_EQ(pair_of(pairs, "poly")["tolerance"], "4 ulps") << "its results differ, in rounding";
    EXPECT_EQ(pair_of(pairs, "near_half")["state"], "differs") << pairs.dump(1);
    EXPECT_NE(pair_of(pairs, "clocked")["state"], "differs") << pairs.dump(1);
}

TEST_F(Difftest, EndsWhatHangsForksOrEatsMemory) {
    if (kSanitized) GTEST_SKIP() << "what runs here is not what is sanitized";
    const std::string code = R"(#include <cstdlib>
#include <unistd.h>
int hangs(int x) { volatile int turns = 1; while (turns) turns = 1 + (x & 1); return x; }
int forks(int x) { if (fork() == 0) { setsid(); for (;;) sleep(1); } return x; }
int eats(int x) { for (;;) { char* p = (char*)malloc(1 << 28); for (int i = 0; i < 1 << 28; i += 4096) p[i] = 1; } return x; }
int leaves(int x) { exit(0); return x; }
int divides(int x) { return 100 / x; }
int well(int x) { return x + 1; }
)";
    const auto start = std::chrono::steady_clock::now();
    const nlohmann::json pairs = run_on("a.cpp", code, "b.cpp", code, {"--inputs", "60"});
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
    EXPECT_EQ(pair_of(pairs, "hangs")["state"], "not_run") << pairs.dump(1);
    EXPECT_EQ(pair_of(pairs, "eats")["state"], "not_run");
    EXPECT_EQ(pair_of(pairs, "leaves")["state"], "not_run");
    EXPECT_EQ(pair_of(pairs, "divides")["state"], "same");
    EXPECT_EQ(pair_of(pairs, "well")["state"], "same");
}

TEST_F(Difftest, HoldsVectorsAgainstNumbersAndGuessesWhatATextLeavesOpen) {
    write("a/Makefile", "FLAGS = -O2 -DSINGLE -DSTEPS=3 -DNAME=$(NAME)\nifdef DEBUG\nFLAGS += -DSTEPS=9\nendif\n");
    write("b/Makefile", "FLAGS = -DSINGLE -DSTEPS=4\n");
    const std::string head =
        "#ifdef SINGLE\ntypedef float real_t;\n#else\n#error reals\n#endif\n"
        "typedef struct pairing { real_t first, second; } *pairing_t;\nenum { LOW = 2, HIGH = 5 };\n";
    const nlohmann::json pairs = run_on("a.cu", head + R"(
float3 limited(float3 v, float3 low, float high) { v.x = fminf(fmaxf(v.x, low.x), high); v.y = fminf(fmaxf(v.y, low.y), high); v.z = fminf(fmaxf(v.z, low.z), high); return v; }
float3 turned(float3 v) { return make_float3(v.y, v.z, v.x); }
float scaled(float x) { return x * STEPS; }
real_t joined(const pairing_t p) { return p->first * LOW + p->second * HIGH; }
float total(const float* values, int count) { float s = 0; for (int i = 0; i < count; ++i) s += values[i]; return s; }
void shifted(float* out, const float* in, int count) { for (int i = 0; i + 1 < count; ++i) out[i] = in[i + 1]; }
float far_away(const float* values) { return values[1000000]; }
template <int N, class T> T power(T x) { T out = x; for (int i = 1; i < N; ++i) out *= x; return out; }
)",
                                        "b.h", head + R"(
float limited(float v, float low, float high) { v = v < low ? low : v; return v > high ? high : v; }
float turned(float v) { return v; }
float scaled(float x) { return x * STEPS; }
real_t joined(const pairing_t p) { return p->first * 2 + p->second * 5; }
float total(const float* values, int count) { float s = 0; for (int i = 0; i < count; ++i) s += values[i]; return s; }
void shifted(float* out, const float* in, int count) { for (int i = 0; i < count; ++i) out[i] = in[i]; }
float far_away(const float* values) { return values[1000000]; }
template <int N, class T> T power(T x) { T out = 1; for (int i = 0; i < N; ++i) out *= x; return out; }
)",
                                        {"--inputs", "1000", "--ulps", "0"});
    const nlohmann::json limited = pair_of(pairs, "limited");
    EXPECT_EQ(limited["state"], "same") << limited.dump(1);
    EXPECT_EQ(limited["reason"].get<std::string>().find("component by component"), 0u) << limited["reason"];
    EXPECT_EQ(pair_of(pairs, "turned")["reason"],
              "the parameters differ: 3 numbers in the source, 1 number in the target")
        << "no function of each component";
    const nlohmann::json scaled = pair_of(pairs, "scaled");
    ASSERT_EQ(scaled["state"], "differs") << "3 against 4: the builds say so";
    EXPECT_EQ(scaled["counterexample"]["target"].get<double>() * 3,
              scaled["counterexample"]["source"].get<double>() * 4);
    EXPECT_EQ(pair_of(pairs, "joined")["state"], "same") << pair_of(pairs, "joined").dump(1);
    EXPECT_EQ(pair_of(pairs, "total")["state"], "same") << pair_of(pairs, "total").dump(1);
    EXPECT_EQ(pair_of(pairs, "total")["reason"], "arrays of 64 elements");
    EXPECT_EQ(pair_of(pairs, "shifted")["state"], "differs") << pair_of(pairs, "shifted").dump(1);
    EXPECT_EQ(pair_of(pairs, "far_away")["reason"], "pointer of unknown length: values");
    EXPECT_EQ(pair_of(pairs, "power")["state"], "same") << pair_of(pairs, "power").dump(1);
}

TEST(BuildDefines, AreReadFromTextsAlone) {
    const auto joined = [](const Macros& macros) {
        std::string out;
        for (const auto& [name, value] : macros) out += name + "=" + value + " ";
        return out;
    };
    EXPECT_EQ(joined(macros_in_flags("-O2 -DA -D B=2 '-DC=3' -DD=$(X) -I -DE=\"q\" -D1=2 -DF=(1+2)")),
              "A=1 B=2 C=3 E=q F=(1+2) ");
    EXPECT_EQ(
        joined(macros_in_makefile("X = -DA \\\n -DB=2 # -DC\nifeq ($(D),1)\nX += -DD\nelse\nX += -DE\nendif\nY=-DF")),
        "A=1 B=2 F=1 ");
    EXPECT_EQ(
        joined(macros_in_cmake("add_definitions(-DA -DB=2)\nif(X)\nadd_definitions(-DC)\nendif()\n"
                               "target_compile_definitions(t PRIVATE D=4 $<X:E>\n PUBLIC F)\n# add_definitions(-DG)\n"
                               "add_compile_definitions(H")),
        "A=1 B=2 D=4 F=1 H=1 ");
    MemoryDisk disk;
    disk.files["/r/build/compile_commands.json"] =
        R"([{"directory": "/r/build", "file": "../a/k.cpp", "command": "g++ -DN=5 -c ../a/k.cpp"}, 7, {"file": 3}])";
    disk.files["/r/a/Makefile"] = "F = -DN=6 -DM\n";
    const std::string root = "/r";
    const BuildDefines build(root, disk, {"GIVEN=1", "N=4"});
    EXPECT_EQ(build.text_for("a/k.cpp"), "#define GIVEN 1\n#define N 4\n") << "what is given wins";
    const BuildDefines plain(root, disk, {});
    EXPECT_EQ(plain.text_for("a/k.cpp"), "#define N 5\n");
    EXPECT_EQ(plain.text_for("a/b/deep.h"), "#define N 6\n#define M 1\n");
    EXPECT_EQ(plain.text_for("k.h"), "");
    disk.files["/r/a/c/Makefile"] = "";
    const BuildDefines beside(root, disk, {});
    EXPECT_EQ(beside.text_for("a/c/k.h"), "") << "the next Makefile is what counts, though nothing stands in it";
}

/// What leads out of the repository, and what never ends, is not read and named.
TEST_F(Difftest, NamesTheFilesOfABuildThatItDoesNotRead) {
    write("a/k.h", "inline float f(float x) { return x * FACTOR; }\n");
    const auto outside = root.parent_path() / (root.filename().string() + "_outside");
    std::ofstream(outside) << "X = -DFACTOR=2\n";
    std::filesystem::create_symlink(outside, root / "a/Makefile");
    std::filesystem::create_directories(root / "build");
    ASSERT_EQ(::mkfifo((root / "build/compile_commands.json").c_str(), 0600), 0);
    const std::string place = root.string();
    const BuildDefines build(place, disk, {});
    EXPECT_EQ(build.text_for("a/k.h"), "");
    ASSERT_EQ(build.unread().size(), 2u);
    EXPECT_EQ(build.unread()[0], "build/compile_commands.json: is not a regular file");
    EXPECT_TRUE(build.unread()[1].starts_with("a/Makefile: ")) << build.unread()[1];
    std::filesystem::remove(outside);
}

TEST_F(Difftest, LeavesNothingBehindWhenInterrupted) {
    const std::string slow =
        "inline float f(float x) { int i = 0; while (i < 2000000000) i += x == x ? 1 : 2; return x + i; }\n";
    write("a/a.h", slow);
    write("b/b.h", slow);
    std::filesystem::create_directory(root / "tmp");
    const pid_t child = fork();
    if (child == 0) {
        setenv("TMPDIR", (root / "tmp").c_str(), 1);
        (void)porttool({"difftest", "--source", "a/*", "--target", "b/*"});
        _exit(0);
    }
    for (int i = 0; i < 500 && std::filesystem::is_empty(root / "tmp"); ++i) usleep(10'000);
    usleep(100'000);  // in the middle of a compilation, or of what it made
    kill(child, SIGINT);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(WEXITSTATUS(status), 130);
    EXPECT_TRUE(std::filesystem::is_empty(root / "tmp"));
}

TEST_F(Difftest, WhereNothingRanStdoutHasAtMostTheJson) {
    write("a/a.cu", "__global__ void k(float* x) { x[0] = 1.0f; }\n");
    write("b/b.cu", "__global__ void k(float* x) { x[0] = 2.0f; }\n");
    const CommandRun text = porttool({"difftest", "--source", "a/*", "--target", "b/*"});
    EXPECT_EQ(text.exit_code, 2);
    EXPECT_EQ(text.out, "");
    EXPECT_NE(text.err.find("a/a.cu:k = b/b.cu:k: not run: a kernel"), std::string::npos) << text.err;
    EXPECT_EQ(std::count(text.err.begin(), text.err.end(), '\n'), 1) << text.err;
    const CommandRun json = porttool({"difftest", "--source", "a/*", "--target", "b/*", "--format", "json"});
    EXPECT_EQ(json.exit_code, 2);
    EXPECT_EQ(nlohmann::json::parse(json.out)["pairs"][0]["state"], "not_run");
}

// What stands around functions in whole repositories: headers of other libraries that take plain words as names, tables
// in conditions, bounds by macros, specialisations.
constexpr const char* kAround = R"(#define ASSERT_SIZE(T) typedef char T##_size[sizeof(T) == 4 ? 1 : -1]
typedef void (*Callback)(float x, int color);
typedef void (LIBRARY_CALL *Loader)(unsigned type, float a);
typedef float Row[4];
#define COUNT 4
#define SQUARE(a) ((a) * (a))
#if defined(__CUDACC__)
__constant__
#endif
static const int kDays[] = {31, 28, 31, 30};
static float up(float x) { return x + 1.0f; }
static float down(float x) { return x - 1.0f; }
static float (*steps[2])(float x) = {up, down};
#define ROW_BEGIN(type, name, size) static const type name[size] = {
#define ROW_END() };
ROW_BEGIN(int, kHours, 3)
    7, 9,
    24
ROW_END()
template <class T> T half_way(T x);
template <> inline float half_way<float>(float x) { return x / 2; }
template <class T> struct Two { using value_type = T; static constexpr int n = 2; value_type x, y; };
)";

TEST_F(Difftest, ReadsWhatStandsAroundFunctions) {
    const std::string own = R"(float three() { return 3.0f; }
float four() { return 4.0f; }
float squared(float x) { return SQUARE(x); }
int days(int month) { return kDays[month]; }
int hours(int day) { return day >= 0 && day < 3 ? kHours[day] : 0; }
float stepped(int which, float x) { return which >= 0 && which < 2 ? steps[which](x) : x; }
float last(float row[COUNT], float scale) { return row[COUNT - 1] * scale; }
template <class T> T lowest_bit(T x) { return x & (x >> 1); }
template <class T> T cross(Two<T> const& a, Two<T> const& b) { return a.x * b.y - a.y * b.x; }
Row spare;
)";
    std::string other = own;
    other.replace(other.find("4.0f"), 4, "4.5f");
    const nlohmann::json pairs = run_on("a.cu", kAround + own, "b.h", kAround + other, {"--inputs", "1000"});
    for (const char* name : {"three", "squared", "days", "hours", "last", "lowest_bit", "cross", "half_way", "stepped"})
        EXPECT_EQ(pair_of(pairs, name)["state"], "same") << pair_of(pairs, name).dump(1);
    // Behind the table stands what the compiler put there: no answer of the function's.
    EXPECT_LT(pair_of(pairs, "days")["inputs"].get<int>(), 500);
    const nlohmann::json four = pair_of(pairs, "four");
    EXPECT_EQ(four["state"], "differs") << "without any input";
    EXPECT_EQ(four["counterexample"]["target"].get<double>(), 4.5);
}

TEST_F(Difftest, WidensHalvesAndTakesTheGreaterOfThem) {
    const nlohmann::json pairs = run_on("a.cu", R"(__device__ float widened(half x) { return __half2float(x) * 2.0f; }
__device__ half greater(half a, half b) { return fmax(a, b); }
__device__ half lesser(half a, half b) { return fmin(a, b); }
)",
                                        "b.cl", R"(float widened(half x) { return (float)x * 2.0f; }
half greater(half a, half b) { return a > b ? a : b; }
half lesser(half a, half b) { return a > b ? a : b; }
)",
                                        {"--inputs", "500"});
    EXPECT_EQ(pair_of(pairs, "widened")["state"], "same") << pairs.dump(1);
    EXPECT_EQ(pair_of(pairs, "greater")["state"], "same") << pairs.dump(1);
    EXPECT_EQ(pair_of(pairs, "lesser")["state"], "differs") << pairs.dump(1);
}

TEST_F(Difftest, RunsWhatNeedsNoObjectAndWhatStandsUnderMacros) {
    write("b/forms.h", R"(#include <complex.h>
struct Vec { double x, y; Vec() { x = 0; y = 0; } Vec(double a, double b) { x = a; y = b; }
  Vec operator*(const Vec& o) const; double size2() const { return x * x + y * y; } };
inline Vec Vec::operator*(const Vec& o) const { return Vec(x * o.x, y * o.y); }
struct Host;
struct Mark { Vec row; bool none; };
struct Box { Box(Host* host); Vec scale; double unused[30]; Mark mark; int steps; double only_here; };
struct Shape { float kept; float plain(float v) const; float held(float v) const { return v * kept; } };
float Shape::plain(float v) const { return v * 2.0f; }
)");
    const nlohmann::json pairs = run_on("a.cl", R"(#ifdef USE_FOG
float fog(float v) { return v + LAYERS_OF(v); }
#endif
#if defined(_WIN32)
float window(float v) { return v; }
#endif
#if LAYERS > 2
float layered(float v) { return v * LAYERS; }
#endif
#ifndef HOST
inline float host_only(float v) { return 0; }
#else
inline float device_only(float v) { return v * 3.0f; }
#endif
float called(float v) { return device_only(v); }
#define PACKED __attribute__((aligned(16)))
typedef struct PACKED { float2 row; } MarkCl;
typedef struct PACKED { int steps; float2 scale; MarkCl mark; } BoxCl;
float2 stretched(float2 p, global BoxCl* box) { return p * box->scale * (float)box->steps; }
float2 marked(float2 p, global BoxCl* box) { return box->mark.row; }
float2 noted(float2 p, global BoxCl* box) { return box->mark.row; }
float2 lacking(float2 p, global BoxCl* box) { return p; }
float spelled(global char* text) { return text[0]; }
float plain(float v) { return v * 2.0f; }
float held(float v) { return v; }
float summed(float a, float b) { return a + b; }
float grown(float a, float b) { return a + b; }
)",
                                        "b.h", R"(#include "forms.h"
float fog(float v) { return v + 1; }
float window(float v) { return v; }
float layered(float v) { return v * 3; }
float called(float v) { return v * 3; }
inline void stretched(Vec& p, const Box& box) { p = p * box.scale * Vec(box.steps, box.steps); }
inline void marked(Vec& p, const Box& box) { p = box.mark.none ? Vec() : box.mark.row; }
inline void noted(Vec& p, const Box& box) { p = box.mark.row; if (box.mark.none) p = box.mark.row; }
inline void lacking(Vec& p, const Box& box) { p.x += box.only_here; }
static int spelled_texts = 0;
float spelled(const char* text) { return text[0] + spelled_texts++; }
float summed(float& a, float& b) { return a + b; }
float grown(float& a, float& b) { a += b; return a; }
)",
                                        {"--inputs", "500"});
    for (const auto& [name, reason] :
         std::vector<std::pair<std::string, std::string>>{{"layered", "with LAYERS defined"},
                                                          {"called", "with HOST defined"},
                                                          {"stretched", ""},
                                                          {"summed", ""},
                                                          {"plain", ""},
                                                          {"marked", "with box.mark.none at 0; at 1 they differ"},
                                                          {"noted", "with box.mark.none at 0 and at 1"}}) {
        EXPECT_EQ(pair_of(pairs, name)["state"], "same") << pair_of(pairs, name).dump(1);
        EXPECT_EQ(pair_of(pairs, name)["reason"].get<std::string>().find(reason), 0u) << pair_of(pairs, name)["reason"];
    }
    EXPECT_EQ(pair_of(pairs, "fog")["reason"], "source: unknown helper LAYERS_OF");
    EXPECT_EQ(pair_of(pairs, "window")["reason"], "source: the preprocessor leaves it out") << "what a compiler says";
    EXPECT_EQ(pair_of(pairs, "held")["reason"], "a member function of Shape") << "it reads a field";
    EXPECT_EQ(pair_of(pairs, "spelled")["reason"], "binding spelled_texts: the other side has none like it")
        << "what no tool could run, before a string";
    for (const char* name : {"lacking", "grown"})
        EXPECT_EQ(pair_of(pairs, name)["state"], "not_run") << pair_of(pairs, name).dump(1);
}

TEST_F(Difftest, ReadsHeadersThatAskWhoIncludesThem) {
    write("common/types.h", R"(#ifndef HAS_TYPES
#if defined(FOR_HOST)
typedef double number;
#define HAS_TYPES
#elif defined(FOR_GPU)
typedef float number;
#define HAS_TYPES
#endif
#if defined(HAS_TYPES)
#define LAYERS 3
typedef struct { number weight; int count; } block;
#endif
#endif
)");
    const char* const gpu = R"(#define FOR_GPU
#include "common/types.h"
__device__ float weighed(const block* b) { return b->weight * b->count + LAYERS; }
__device__ int bytes(int n) { return n * (int)sizeof(number); }
)";
    const nlohmann::json pairs = run_on("a.cu", gpu, "b.cpp", R"(#define FOR_HOST
#include "common/types.h"
float weighed(const block* b) { return b->weight * b->count + 3; }
int bytes(int n) { return n * 8; }
)",
                                        {"--inputs", "500", "--ulps", "8"});
    EXPECT_NE(pair_of(pairs, "weighed")["state"], "not_run") << pair_of(pairs, "weighed").dump(1);
    EXPECT_EQ(pair_of(pairs, "bytes")["state"], "differs") << "4 here, 8 there: each includes its own branch";
    EXPECT_EQ(pair_of(pairs, "bytes")["counterexample"]["source"], 4) << pair_of(pairs, "bytes").dump(1);
}

TEST_F(Difftest, TakesSyclForCpp) {
    nlohmann::json pairs = run_on("a.cu", R"(
__device__ float root(float x) { return sqrtf(x); }
__device__ float second(float2 v) { return v.x * 2.0f + v.y; }
__device__ int product(int a, int b) { return a * b; }
__device__ float halves(half2 a, half2 b) { return __low2float(__hmul2(a, b)) + (float)__high2half(__hsub2(a, b)); }
__device__ float turned(half2 v) { const float2 f = __half22float2(v); return f.x - f.y; }
)",
                                  "b.cpp", R"(
template <class T> T root(T x) {
    if constexpr (std::is_same_v<T, sycl::ext::oneapi::bfloat16>) { return sycl::ext::oneapi::experimental::sqrt(x); }
    else { return sycl::sqrt(x); } }
float second(sycl::float2 v) { return v.x() * 2.0f + v.y(); }
template <typename A, typename B> using wide = std::conditional_t<std::is_unsigned_v<A> && std::is_unsigned_v<B>, unsigned, int>;
int product(int a, int b) { wide<int, int> out = a * b; return out; }
float halves(sycl::half2 a, sycl::half2 b) {
    const sycl::half2 c = a * b, d = a - b; return (float)c.x() + (float)d.y(); }
float turned(sycl::half2 v) {
    const sycl::float2 f = v.convert<float, sycl::rounding_mode::automatic>(); return f.x() - f.y(); }
)",
                                  {"--inputs", "500", "--ulps", "0"});
    for (const char* name : {"root", "second", "product", "halves", "turned"})
        EXPECT_EQ(pair_of(pairs, name)["state"], "same") << pair_of(pairs, name).dump(1);
    // A method of that name is one.
    pairs = run_on("a.cu", "__device__ float held(float v) { return v * 3.0f; }\n", "b.cpp", R"(
struct Held { float v; float x() const { return v * 3.0f; } };
float held(float v) { sycl::float2 unused; Held h{v}; return h.x(); }
)",
                   {"--inputs", "500"});
    EXPECT_EQ(pair_of(pairs, "held")["state"], "same") << pair_of(pairs, "held").dump(1);
}

TEST_F(Difftest, RunsVectorsOfBytesPartsWithoutANameAndWhatOneSideTakesAlone) {
    const std::string block = R"(#define PARTS
#define NAMED data
#define EXTENSION
typedef struct { EXTENSION union { struct { float d; float s; } both; float sum; } PARTS; int qs[4]; } block;
typedef struct { union { struct { float d; float s; } both; float sum; } NAMED; int qs[4]; } named_block;
)";
    const nlohmann::json pairs = run_on("a.cu", block + R"(
typedef signed char bytes __attribute__((ext_vector_type(4)));
__device__ float tangled(const block* b, int k) { return b[0].sum + b[0].qs[k & 3] * 2.0f; }
__device__ float of_named(const named_block* b, int k) { return b[0].data.sum + b[0].qs[k & 3] * 2.0f; }
__device__ int product(int a, int b) {
    const bytes x = reinterpret_cast<const bytes&>(a), y = reinterpret_cast<const bytes&>(b);
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2] + x[3] * y[3]; }
__device__ float row_of(const float* rows, int first, int i) { return rows[first * 4 + (i & 3)] * 2.0f; }
__device__ float tilted_row(const float* rows, int first, int i) { return rows[first * 4 + (i & 3)] * 2.0f + 1.0f; }
__device__ float scaled_row(const float* rows, float by, int i) { return rows[i & 3] * 2.0f + by; }
)",
                                        "b.cpp", block + R"(
float tangled(const block* b, int k) { return b[0].sum + b[0].qs[k & 3] * 2.0f; }
float of_named(const named_block* b, int k) { return b[0].data.sum + b[0].qs[k & 3] * 2.0f; }
int product(int a, int b) {
    auto x = sycl::vec<int, 1>(a).template as<sycl::vec<int8_t, 4>>().template convert<int>();
    auto y = sycl::vec<int, 1>(b).template as<sycl::vec<int8_t, 4>>().template convert<int>();
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2] + x[3] * y[3]; }
float row_of(const float* rows, int i) { return rows[i & 3] * 2.0f; }
float tilted_row(const float* rows, int i) { return rows[i & 3] * 2.0f; }
float scaled_row(const float* rows, int i) { return rows[i & 3] * 2.0f; }
)",
                                        {"--inputs", "500", "--ulps", "0"});
    for (const char* name : {"tangled", "of_named", "product", "row_of"})
        EXPECT_EQ(pair_of(pairs, name)["state"], "same") << pair_of(pairs, name).dump(1);
    EXPECT_NE(pair_of(pairs, "row_of")["reason"].get<std::string>().find("with first at 0"), std::string::npos);
    // That the other side does with 0 what this one does with any was a guess, and a wrong one.
    for (const char* name : {"tilted_row", "scaled_row"})
        EXPECT_EQ(pair_of(pairs, name)["state"], "not_run") << pair_of(pairs, name).dump(1);
}

/// C as it was written before it had prototypes, and what C++ reads otherwise.
constexpr const char* kOldC = R"(#include QUOTED(FOLDER/units.h)
#include <complex.h>
int shown = 1, counted = 0;
typedef struct item { struct item *next; float weight; int (*less)(const void *a, const void *b); FILE *log; } item;
typedef struct { int rows, columns; float **entries; float *scale; item *first; } table;
double squared(x)
double x;
{ return x * x; }
double mixed(a, b, n, values) float a, *b; double values[]; { return a + b[0] * n + values[1]; }
#ifndef NEWER
float twofold(v)
pairing *v;
#else
float twofold(pairing *v)
#endif
{ return v->first * FACTOR + v->second; }
int shifted(a, b) register int a; register int b; { return a << 1 | b; }
int counts(int new) { return new + counted; }
int delta(int new, int class) { return new - class * 2; }
float imaginary(float I) { return I * 2.0f; }
#ifdef WIDE_WORDS
struct word { unsigned low, high; };
#else
typedef unsigned word;
#endif
word turned(word x) { return x << 3 | x >> 29; }
float entry(const table *t, int i) { return t->entries[i][1] * t->scale[i]; }
void scaled(table *t, float by) { int i; for (i = 0; i < t->rows && i < 4; ++i) t->scale[i] *= by; }
float heaviest(const item *i) { return i->next ? i->next->weight : i->weight; }
void reset(item *i, item *other) { i->next = other->next; i->weight = 0; }
float block_sum(const void *data, int n) { const pairing *p = (const pairing *)data; return p[n].first + p[n].second; }
int bytes(const unsigned char *data, int n) { return data[n] * 3; }
int logged(FILE *f, int n) { fprintf(f, "%d", n); return n; }
#ifndef ANSI_C
int first_step();
#else
int first_step(int x);
#endif
static int (*steps[2])(int) = {first_step, first_step};
#ifndef ANSI_C
int first_step(x) int x;
#else
int first_step(int x)
#endif
{ return x > 0 && x < 9 ? steps[1](x + 1) : x; }
int again(int n) { return n < 1 || n > 9 ? 1 : n * again(n - 1); }
)";

TEST_F(Difftest, RunsOldCAndFollowsPointersOfStructs) {
    write("a/units.h", "typedef struct { float first, second; } pairing;\n#define FACTOR 2\n");
    write("b/units.h", "typedef struct { float first, second; } pairing;\n#define FACTOR 2\n");
    const std::vector<std::string> same = {"squared", "mixed",  "twofold",  "delta",      "imaginary",
                                           "entry",   "scaled", "heaviest", "block_sum",  "bytes",
                                           "reset",   "again",  "turned",   "first_step", "shifted"};
    nlohmann::json pairs = run_on("a.c", kOldC, "b.c", kOldC, {"--inputs", "600", "--ulps", "0"});
    for (const std::string& name : same) EXPECT_EQ(pair_of(pairs, name)["state"], "same") << pair_of(pairs, name);
    EXPECT_EQ(pair_of(pairs, "logged")["reason"], "input and output: f");
    EXPECT_EQ(pair_of(pairs, "counts")["state"], "same") << "its variable stands behind another one's value";
    EXPECT_EQ(pair_of(pairs, "entry")["reason"], "arrays of at most 64 elements");
    // Each with another text on one side: what is drawn is looked at.
    std::string other = kOldC;
    for (const auto& [from, to] :
         std::initializer_list<std::pair<std::string, std::string>>{{"x * x", "x + x"},
                                                                    {"values[1]", "values[2]"},
                                                                    {"v->first * FACTOR", "v->first"},
                                                                    {"class * 2", "class"},
                                                                    {"I * 2.0f", "I * 3.0f"},
                                                                    {"entries[i][1]", "entries[i][2]"},
                                                                    {"scale[i] *= by", "scale[i] += by"},
                                                                    {"i->next->weight : i", "i->weight : i"},
                                                                    {"i->next = other->next; ", ""},
                                                                    {"p[n].second", "p[0].second"},
                                                                    {"data[n] * 3", "data[n] * 4"},
                                                                    {"n * again", "n + again"},
                                                                    {"x << 3", "x << 4"},
                                                                    {"a << 1", "a << 2"},
                                                                    {"steps[1](x + 1)", "steps[1](x + 2)"}})
        other = replaced(other, from, to);
    pairs = run_on("a.c", kOldC, "b.c", other, {"--inputs", "600", "--ulps", "0"});
    for (const std::string& name : same) EXPECT_EQ(pair_of(pairs, name)["state"], "differs") << pair_of(pairs, name);
}

TEST_F(Difftest, SaysWhatIsMissing) {
    write("a/a.glsl", "float half_of(float x) { return x * 0.5; }\n");
    write("b/b.h", "inline float half_of(float x) { return x * 0.5f; }\n");
    const CommandRun unknown = porttool({"difftest", "a/a.glsl:halfof", "--source", "a/*", "--target", "b/*"});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_NE(unknown.err.find("did you mean 'a/a.glsl:half_of'?"), std::string::npos) << unknown.err;
    EXPECT_EQ(unknown.out, "");
    const CommandRun ulps = porttool({"difftest", "--source", "a/*", "--target", "b/*", "--ulps", "some"});
    EXPECT_EQ(ulps.exit_code, 2);
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nowhere", 1);
    const CommandRun none = porttool({"difftest", "--source", "a/*", "--target", "b/*"});
    setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_NE(none.err.find("no compiler"), std::string::npos) << none.err;
}

}  // namespace
}  // namespace porttool::testing
