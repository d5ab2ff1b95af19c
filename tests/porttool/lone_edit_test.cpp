// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Edits of one side alone, labelled by hand from what the languages say: those that change no value raise nothing, and
// `qualifiers` when it is asked for; those that can change one are found.
#include <gtest/gtest.h>

#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::lone_edit_test {
namespace {

/// A file with one function `f`, in a language that the suffix tells, and what is edited in it.
struct LabelledEdit {
    std::string suffix, text, from, to;
};

const std::string kC = R"(
float f(const float* a, int n, float s) {
    float sum = 0.0f;
    for (int i = 0; i < n; ++i) { sum += a[i] * s; }
    unsigned int k = (unsigned int)sum;
    return sum + (float)k;
}
)";
const std::string kStep = R"(
void f(float* a, const int n) {
    int i;
    for (i = 0; i < n; i++) a[i] = a[i] * 2.0f;
    a[0] = 1.0f;
}
)";
const std::string kSwitch = R"(
int f(int a, int n) {
    for (int i = 0; i < n; ++i) {
        switch (a) {
            case 0: { a += 2; break; }
            case 1: a += 3; break;
            default: { a = i; break; }
        }
        if (a > 9) { break; }
    }
    while (a > 0) { a -= n; break; }
    switch (n) { case 1: while (a > 0) { a -= 3; break; } }
    return a;
}
)";
const std::string kThreads = R"(
void f(float* a, int n) {
    #pragma omp parallel for schedule(static)
    for (int i = 0; i < n; ++i) a[i] *= 2.0f;
}
)";
const std::string kRace = R"(
float f(float* a, int n, int m) {
    float sum = 0.0f, last = 0.0f;
    #pragma omp parallel for collapse(2) private(last) reduction(+:sum)
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < m; ++k) { last = a[i * m + k]; sum += last; }
    #pragma omp parallel
    {
        #pragma omp for nowait schedule(static)
        for (int i = 0; i < n; ++i) a[i] += sum;
        #pragma omp barrier
        #pragma omp critical
        { a[0] += 1.0f; }
        #pragma omp atomic
        a[1] += 1.0f;
    }
    #pragma omp simd reduction(+:sum)
    for (int i = 0; i < n; ++i) sum += a[i];
    return sum;
}
)";
const std::string kKernel = R"(
__device__ static float g(float x) { return x; }
__global__ void __launch_bounds__(128, 4) f(const float* __restrict__ in, float* __restrict__ out, int n) {
    __shared__ float tile[128];
    const int i = blockIdx.x * blockDim.x + threadIdx.x;
    volatile float* seen = out;
    tile[threadIdx.x] = in[i];
    __syncthreads();
    #pragma unroll 4
    for (int k = 0; k < 4; ++k) out[i] += tile[k];
    if (i < n) seen[i] = (float)i;
}
)";
const std::string kOpenCl = R"(
__kernel __attribute__((reqd_work_group_size(64, 1, 1)))
void f(__global const float* restrict in, __global volatile float* out, __constant float* w, const uint n) {
    __local float tile[64];
    __private float x = in[0];
    const uint i = get_global_id(0);
    tile[0] = (float)i;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (i < n) out[i] = x + tile[0] * w[0];
}
)";
const std::string kNowaitBefore = R"(
void f(float* a, float* b, int n) {
    #pragma omp parallel
    {
        #pragma omp for schedule(static) nowait
        for (int i = 0; i < n; ++i) a[i] += 1.0f;
        #pragma omp for schedule(guided)
        for (int i = 0; i < n; ++i) b[i] += a[i];
    }
}
)";
const std::string kGlsl = R"(
layout(local_size_x = 64, local_size_y = 1) in;
shared float tile[64];
float gain;
void f(in float x, inout float y, const uint n) {
    precise float z = x * 0.5f + y;
    highp float w = z;
    y = w + tile[n] * gain;
}
)";
const std::string kIspc = R"(
export void f(uniform float a[], const uniform int n, varying float s) {
    uniform int k = 0;
    varying float x = s;
    foreach (i = 0 ... n) { a[i] = x * s; }
    for (uniform int j = 0; j < n; ++j) k += 1;
}
)";
const std::string kSycl = R"(
#include <sycl/sycl.hpp>
SYCL_EXTERNAL void f(const float* in, float* out, const sycl::nd_item<3>& item) {
    const int i = item.get_local_id(2);
    sycl::atomic_ref<float, sycl::memory_order::relaxed, sycl::memory_scope::device> sum(out[0]);
    [[intel::fpga_register]] float t = static_cast<float>(i);
    #pragma unroll
    for (int k = 0; k < 4; ++k) out[i] += in[k] * t;
    sum += 1.0f;
}
)";
const std::string kMember = R"(
struct S { float v; };
virtual float f(S s, S* p, unsigned char c) const noexcept {
    static int calls = 0;
    const S* q = static_cast<const S*>(p);
    if (q == nullptr) return 0.0f;
    calls++;
    return (q->v + s.v) * c;
}
)";
const std::string kGlobals = R"(
static volatile int ready = 0;
static float cache[4];
__device__ int counter;
float f(float x) {
    while (!ready) { }
    counter += 1;
    return x + cache[0];
}
)";

const std::string kPragma = R"code(
void f(float* a, int n) {
    _Pragma("omp parallel for reduction(+:sum) schedule(static)") for (int i = 0; i < n; ++i) sum += a[i];
}
)code";
const std::string kLaunch = R"(
void f(float* a, int n, hipStream_t s) {
    fill<<<n, 64>>>(a, n);
    my::add<float, 4><<<dim3(n, 1), 64, 0, s>>>(a);
}
)";
const std::string kRuntime = R"(
void f(float* a, int n) {
    gpuErrchk(cudaMalloc(&a, n));
    check_rows(own(a));
    cudaFree(a);
}
)";
/// What a file says apart from the definition.
const std::string kApart = R"(
#pragma STDC FP_CONTRACT OFF
static int calls;
#pragma omp threadprivate(calls)
float f(float x, float s = 2.0f);
template <int N> float f(float x, float s) { calls += 1; return x * s + N; }
template float f<4>(float, float);
)";

const std::vector<LabelledEdit> kSilent = {
    // what a function does not use, or where the host binds what it uses
    {".glsl", "layout(std430, binding = 0) buffer B { float v[]; } b;\nvoid f() { b.v[0] = 1.0; }", "binding = 0",
     "binding = 1"},
    {".cl", kOpenCl, "    if (i < n)", "    __attribute__((opencl_unroll_hint(4)))\n    if (i < n)"},
    {".hlsl", kStep, "    for (i", "    [unroll] for (i"},
    // const
    {".c", kC, "const float* a", "float* a"},
    {".c", kC, "int n, float s", "const int n, float s"},
    {".c", kC, "int n, float s", "const int n, const float s"},
    {".cpp", kC, "unsigned int k", "const unsigned int k"},
    {".cpp", kStep, "float* a, const int n", "float* const a, int n"},
    {".cu", kKernel, "const int i", "int i"},
    {".cu", kKernel, "int n)", "const int n)"},
    {".cu", kKernel, "blockIdx.x * blockDim.x + threadIdx.x", "(blockDim.x * blockIdx.x) + threadIdx.x"},
    {".cu", kKernel, "blockIdx.x * blockDim.x + threadIdx.x", "threadIdx.x + blockIdx.x * blockDim.x"},
    {".cl", kOpenCl, "const uint n", "uint n"},
    {".cl", kOpenCl, "const uint i", "uint i"},
    {".cpp", kMember, "const S* q", "const S* const q"},
    {".cpp", kC, "float f(", "constexpr float f("},
    {".ispc", kIspc, "const uniform int n", "uniform int n"},
    {".glsl", kGlsl, "const uint n", "uint n"},
    {".dp.cpp", kSycl, "const int i", "int i"},
    {".hip", kKernel, "const int i", "int i"},
    // how a function is called and linked
    {".c", kC, "float f(", "static float f("},
    {".c", kC, "float f(", "static inline float f("},
    {".c", kC, "float f(", "extern float f("},
    {".cpp", kC, "float f(", "inline float f("},
    {".cpp", kC, "float f(", "extern \"C\" float f("},
    {".cpp", kC, "float s)", "float s) noexcept"},
    {".cpp", kMember, "const noexcept {", "const {"},
    {".cpp", kC, "float f(", "[[nodiscard]] float f("},
    {".cpp", kC, "float f(", "__attribute__((always_inline)) inline float f("},
    {".c", kC, "float f(", "__attribute__((noinline, hot)) float f("},
    {".cpp", kC, "float f(", "__declspec(noinline) float f("},
    {".cpp", kC, "float f(", "float __vectorcall f("},
    {".cu", kKernel, "__global__ void", "static __global__ void"},
    {".hip", kKernel, "__global__ void", "extern \"C\" __global__ void"},
    {".dp.cpp", kSycl, "SYCL_EXTERNAL void", "void"},
    {".cpp", kC, "int n, float s", "[[maybe_unused]] int n, float s"},
    {".cl", kC, "float f(", "OUR_FORCE_NOT_INLINE float f("},
    {".c", kC, "float f(", "static ALWAYS_INLINE float f("},
    // restrict
    {".cu", kKernel, "float* __restrict__ out", "float* out"},
    {".cl", kOpenCl, "float* restrict in", "float* in"},
    {".c", kC, "const float* a", "const float* restrict a"},
    {".c", kC, "const float* a", "const float* __restrict a"},
    // nothing is left to leave
    {".c", kSwitch, "a = i; break; }", "a = i; }"},
    {".cpp", kSwitch, "a -= 3; break; } }", "a -= 3; break; } break; }"},
    // pragmas that only advise
    {".cu", kKernel, "#pragma unroll 4\n", "\n"},
    {".cu", kKernel, "#pragma unroll 4", "#pragma unroll"},
    {".hip", kKernel, "#pragma unroll 4", "#pragma unroll (8)"},
    {".dp.cpp", kSycl, "#pragma unroll\n", "\n"},
    {".cpp", kC, "    for (int i", "    #pragma GCC ivdep\n    for (int i"},
    {".cpp", kC, "    for (int i", "    #pragma ivdep\n    for (int i"},
    {".cpp", kC, "    for (int i", "    #pragma omp simd\n    for (int i"},
    {".cpp", kC, "    for (int i", "    _Pragma(\"unroll\")\n    for (int i"},
    {".c", kC, "    float sum", "    #pragma GCC diagnostic ignored \"-Wconversion\"\n    float sum"},
    {".cpp", kC, "    float sum", "    #pragma warning(disable : 4244)\n    float sum"},
    {".cpp", kC, "    for (int i", "    #pragma clang loop unroll(full)\n    for (int i"},
    {".c", kThreads, "schedule(static)", "schedule(dynamic, 16)"},
    {".c", kThreads, " schedule(static)", ""},
    {".c", kThreads, "schedule(static)", "num_threads(omp_get_max_threads()) schedule(static)"},
    {".cpp", replaced(kThreads, "schedule(static)", "num_threads(8u)"), "num_threads(8u)", "num_threads(16)"},
    {".cpp", kThreads, "parallel for schedule(static)", "parallel for simd schedule(guided)"},
    {".c", replaced(kThreads, "parallel for", "parallel for if(n > 9),"), "schedule(static)", "schedule(dynamic)"},
    {".c", kPragma, "schedule(static)", "schedule(dynamic)"},
    // where numbers without a value are declared
    {".c", "void f(int* a) { g(a); int i, b[4]; h(a); i = 2; a[0] = i; }", "g(a); int i, b[4];", "int i, b[4]; g(a);"},
    // whether somebody looks at the status of a call
    {".cu", kRuntime, "cudaFree(a);", "CUDA_CHECK(cudaFree(a));"},
    {".cu", kRuntime, "gpuErrchk(cudaMalloc(&a, n))", "cudaMalloc(&a, n)"},
    // how a kernel is launched
    {".hip", kLaunch, "fill<<<n, 64>>>(a, n)", "hipLaunchKernelGGL(fill, dim3(n), dim3(64), 0, 0, a, n)"},
    {".hip", kLaunch, "my::add<float, 4><<<dim3(n, 1), 64, 0, s>>>(a)",
     "hipLaunchKernelGGL((my::add<float, 4>), dim3(n, 1), 64, 0, s, a)"},
    // one component of what the text declares as a vector
    {".glsl", "float f(vec3 v) { return v.x; }", "v.x", "v.r"},
    {".comp", "float f(vec4 v) { vec2 w = v.zw; return w.y; }", "v.zw", "v.pq"},
    // where the type stands that a function gives back
    {".cpp", "float f(float x) { return x; }", "float f(float x)", "auto f(float x) -> float"},
    // another spelling of one type
    {".c", kC, "unsigned int k", "uint32_t k"},
    {".cpp", kC, "unsigned int k = (unsigned int)sum", "unsigned int k = sum"},
    {".ispc", "float f(uniform uint8 n) { return n; }", "uint8", "unsigned int8"},
    {".c", kC, "unsigned int k", "unsigned k"},
    {".cpp", kC, "unsigned int k", "std::uint32_t k"},
    {".cu", kC, "unsigned int k", "uint k"},
    {".cpp", kMember, "unsigned char c", "uint8_t c"},
    {".cpp", "float f(unsigned __int64 n, __int64 k) { return n + k; }", "unsigned __int64 n, __int64 k",
     "uint64_t n, int64_t k"},
    {".cl", kOpenCl, "const uint n", "const unsigned int n"},
    {".cl", kOpenCl, "__kernel", "kernel"},
    {".cl", kOpenCl, "__local float tile", "local float tile"},
    {".cpp", kMember, "f(S s,", "f(struct S s,"},
    // casts, NULL, values in parentheses
    {".cpp", kC, "(float)k", "static_cast<float>(k)"},
    {".cpp", kC, "(float)k", "float(k)"},
    {".cpp", kC, "(unsigned int)sum", "static_cast<unsigned>(sum)"},
    {".cpp", kMember, "static_cast<const S*>(p)", "(const S*)p"},
    {".cpp", kMember, "q == nullptr", "q == NULL"},
    {".dp.cpp", kSycl, "static_cast<float>(i)", "(float)i"},
    {".cpp", kMember, "return (q->v + s.v) * c", "return ((q->v + s.v) * c)"},
    // statements that do nothing
    {".c", kStep, "a[0] = 1.0f;", "a[0] = 1.0f; return;"},
    {".c", kStep, "a[0] = 1.0f;", "a[0] = 1.0f;;"},
    {".c", kStep, "a[0] = 1.0f;", "a[0] = 1.0f; (void)n;"},
    {".c", kStep, "i++", "++i"},
    {".c", "void f(int* a) { advise(a, 4); }", "advise", "(void) advise"},
    {".cpp", kMember, "calls++", "++calls"},
    {".c", kStep, "    int i;", "    register int i;"},
    // defaults of a language
    {".glsl", kGlsl, "in float x", "float x"},
    {".glsl", kGlsl, "0.5f", "0.5"},
};

const std::vector<LabelledEdit> kHarmful = {
    // a break that leaves something
    {".c", kSwitch, "a += 2; break; }", "a += 2; }"},
    {".c", kSwitch, "a += 3; break;", "a += 3;"},
    {".cpp", kSwitch, "{ break; }", "{ }"},
    {".cpp", kSwitch, "a -= n; break; }", "a -= n; }"},
    {".cu", kSwitch, "a -= 3; break; }", "a -= 3; }"},
    {".c", "int i; void f(int* a) { if (a) { int i; i = 1; } i = 2; }", "if (a) { int i;", "int i; if (a) {"},
    {".c", "int i; void f(int* a) { g(a, i); int i; i = 2; }", "g(a, i); int i;", "int i; g(a, i);"},
    {".c", "void f(int* a) { g(a); int i = *a; h(a, i); }", "g(a); int i = *a;", "int i = *a; g(a);"},
    {".cpp", "void f(int* a) { g(a); Guard b[4]; h(a); }", "g(a); Guard b[4];", "Guard b[4]; g(a);"},
    {".cu", kRuntime, "check_rows(own(a));", "own(a);"},
    {".cu", kKernel, "blockIdx.x * blockDim.x + threadIdx.x", "blockIdx.x * blockDim.y + threadIdx.x"},
    {".cu", kKernel, "blockIdx.x * blockDim.x + threadIdx.x", "blockIdx.x * (blockDim.x + threadIdx.x)"},
    {".cu", kKernel, "blockIdx.x * blockDim.x + threadIdx.x", "blockIdx.x * blockDim.x + threadIdx.y"},
    {".cu", kRuntime, "cudaFree(a);", "CUDA_CHECK(cudaFree(b));"},
    {".cu", kRuntime, "cudaFree(a);", "assert(cudaFree(a));"},
    {".hip", kLaunch, "fill<<<n, 64>>>(a, n)", "hipLaunchKernelGGL(fill, n, 32, 0, 0, a, n)"},
    {".hip", kLaunch, "fill<<<n, 64>>>(a, n)", "hipLaunchKernelGGL(fill, n, 64, 16, 0, a, n)"},
    {".hip", kLaunch, "fill<<<n, 64>>>(a, n)", "fill<<<n, 64, 0, s>>>(a, n)"},
    // what stands apart from the definition
    {".cpp", kApart, "CONTRACT OFF", "CONTRACT ON"},
    {".cpp", kApart, "#pragma STDC FP_CONTRACT OFF\n", ""},
    {".cpp", kApart, "#pragma omp threadprivate(calls)\n", ""},
    {".cpp", kApart, "s = 2.0f", "s = 3.0f"},
    {".cpp", kApart, "float s = 2.0f", "float s"},
    {".cpp", kApart, "f<4>", "f<8>"},
    {".cpp", kApart, "template float f<4>(float, float);\n", ""},
    {".cpp", "struct S { float f(float x, float s = 2.0f); };\nfloat S::f(float x, float s) { return x * s; }", "2.0f",
     "3.0f"},
    {".c", kPragma, " reduction(+:sum)", ""},
    {".c", kPragma, "reduction(+:sum)", "reduction(*:sum)"},
    {".glsl", "struct P { float r; float x; };\nfloat f(P v) { return v.x; }", "v.x", "v.r"},
    {".glsl", "float f(vec3 v) { return v.x; }", "v.x", "v.g"},
    {".cpp", "float f(float x) { return x; }", "float f(float x)", "auto f(float x) -> double"},
    {".cpp", "auto f(float x) { return x; }", "auto f(float x)", "auto f(float x) -> double"},
    // C++ and CUDA have no second name for a part: what is called so may be any type
    {".cu", "struct half4 { float x, y, r, g; };\nfloat f(half4 v) { return v.x; }", "return v.x", "return v.r"},
    {".cpp", "float f(float4 v) { return v.x; }", "v.x", "v.r"},
    {".cpp", "float f(vec4 v) { return v.x; }", "v.x", "v.r"},
    {".c", kGlobals, "static volatile int ready", "static int ready"},
    {".c", kGlobals, "static float cache", "float cache"},
    {".cu", kGlobals, "__device__ int counter", "__device__ volatile int counter"},
    {".cpp", kGlobals, "static float cache", "static thread_local float cache"},
    {".comp", replaced(kGlsl, "void f(in float x, inout float y, const uint n) {", "void main() { float x, y; uint n;"),
     "local_size_x = 64", "local_size_x = 128"},
    {".comp", replaced(kGlsl, "void f(in float x, inout float y, const uint n) {", "void main() { float x, y; uint n;"),
     ", local_size_y = 1", ", local_size_y = 2"},
    {".glsl", kGlsl, "shared float tile", "float tile"},
    {".glsl", "layout(std430) coherent buffer B { float v[]; } b;\nvoid f() { b.v[0] = 1.0; }", "coherent buffer",
     "buffer"},
    {".c", "static volatile int ready, done;\nint f(void) { return ready; }\n", "static volatile int ready, done",
     "static int ready; static volatile int done"},
    // static and volatile
    {".c", kC, "float sum = 0.0f", "static float sum = 0.0f"},
    {".c", kC, "float sum = 0.0f", "volatile float sum = 0.0f"},
    {".cpp", kMember, "static int calls", "int calls"},
    {".cpp", kMember, "static int calls", "static volatile int calls"},
    {".cpp", kMember, "static int calls", "static thread_local int calls"},
    {".cu", kKernel, "volatile float* seen", "float* seen"},
    {".hip", kKernel, "volatile float* seen", "float* seen"},
    {".cu", kKernel, "__shared__ float tile", "volatile __shared__ float tile"},
    {".cl", kOpenCl, "__global volatile float* out", "__global float* out"},
    {".cpp", kC, "const float* a", "const volatile float* a"},
    // OpenMP
    {".c", kRace, " reduction(+:sum)\n    for (int i = 0; i < n; ++i)\n        for",
     "\n    for (int i = 0; i < n; ++i)\n        for"},
    {".c", kRace, "reduction(+:sum)", "reduction(*:sum)"},
    {".c", kRace, " private(last)", ""},
    {".c", kRace, "private(last)", "lastprivate(last)"},
    {".c", kRace, "private(last)", "shared(last)"},
    {".cpp", kRace, "private(last)", "firstprivate(last)"},
    {".c", kRace, " collapse(2)", ""},
    {".c", kRace, "collapse(2)", "collapse(3)"},
    {".c", kRace, " nowait", ""},
    {".c", kRace, "nowait schedule(static)", "nowait schedule(dynamic)"},
    {".c", kNowaitBefore, "schedule(guided)", "schedule(dynamic)"},
    {".c", kRace, "        #pragma omp barrier\n", ""},
    {".c", kRace, "        #pragma omp critical\n", ""},
    {".c", kRace, "#pragma omp critical", "#pragma omp master"},
    {".cpp", kRace, "        #pragma omp atomic\n", ""},
    {".c", kRace, "#pragma omp atomic", "#pragma omp critical"},
    {".c", kRace, "    #pragma omp parallel\n", "\n"},
    {".c", kRace, "omp simd reduction(+:sum)", "omp simd"},
    {".c", kRace, "    #pragma omp simd reduction(+:sum)\n", ""},
    {".c", kThreads, "    #pragma omp parallel for schedule(static)\n", ""},
    {".cpp", kThreads, "omp parallel for", "omp for"},
    {".c", kThreads, "schedule(static)", "schedule(static) ordered"},
    {".c", kThreads, "schedule(static)", "schedule(static) nowait"},
    {".cpp", kThreads, "schedule(static)", "num_threads(1)"},
    {".cpp", kThreads, "schedule(static)", "num_threads(1u)"},
    {".cpp", kThreads, "schedule(static)", "num_threads((1))"},
    {".cpp", kThreads, "schedule(static)", "num_threads(kSerial)"},
    {".cpp", kThreads, "schedule(static)", "num_threads(2 - 1)"},
    {".cpp", replaced(kThreads, "a[i]", "a[ThreadIndex()]"), "schedule(static)", "num_threads(8) schedule(static)"},
    {".c", "void f(int* a) {\n    #pragma omp parallel\n    { g(a); }\n}", "omp parallel",
     "omp parallel num_threads(8)"},
    {".c", replaced(kThreads, "a[i] *= 2.0f", "a[i] *= omp_get_num_threads()"), "schedule(static)", "num_threads(8)"},
    {".cpp", kC, "    for (int i", "    #pragma omp simd safelen(4)\n    for (int i"},
    {".c", kC, "    for (int i", "    #pragma omp parallel for\n    for (int i"},
    {".cpp", kC, "    float sum", "    #pragma STDC FP_CONTRACT OFF\n    float sum"},
    // launch bounds and work-group sizes
    {".cu", kKernel, "__launch_bounds__(128, 4)", "__launch_bounds__(256, 4)"},
    {".cu", kKernel, "__launch_bounds__(128, 4)", "__launch_bounds__(128)"},
    {".hip", kKernel, "__launch_bounds__(128, 4) ", ""},
    {".cl", kOpenCl, "reqd_work_group_size(64, 1, 1)", "reqd_work_group_size(32, 1, 1)"},
    {".cl", kOpenCl, "__attribute__((reqd_work_group_size(64, 1, 1)))", ""},
    {".hlsl", "[numthreads(64, 1, 1)] void f(uint i) { Out[i] = 1; }", "64, 1", "32, 2"},
    {".dp.cpp", replaced(kSycl, "SYCL_EXTERNAL", "[[sycl::reqd_work_group_size(1, 1, 64)]]"), "1, 1, 64", "1, 1, 32"},
    // address spaces
    {".cl", kOpenCl, "__local float tile", "__private float tile"},
    {".cl", kOpenCl, "__local float tile", "float tile"},
    {".cl", kOpenCl, "__constant float* w", "__global float* w"},
    {".cl", kOpenCl, "__private float x", "__local float x"},
    {".cl", kOpenCl, "__global const float* restrict in", "__constant float* restrict in"},
    {".cu", kKernel, "__shared__ float tile", "float tile"},
    {".cu", kKernel, "__shared__ float tile[128]", "extern __shared__ float tile[]"},
    {".metal", "kernel void f(device float* a, threadgroup float* b) { a[0] = b[0]; }", "threadgroup float* b",
     "device float* b"},
    // ISPC
    {".ispc", kIspc, "varying float s", "uniform float s"},
    {".ispc", kIspc, "uniform int k", "int k"},
    {".ispc", kIspc, "uniform int k", "varying int k"},
    {".ispc", kIspc, "varying float x", "float x"},
    {".ispc", kIspc, "uniform float a[]", "float a[]"},
    {".ispc", kIspc, "uniform int j", "varying int j"},
    {".ispc", kIspc, "export void", "task void"},
    // GLSL
    {".glsl", kGlsl, "precise float z", "float z"},
    {".glsl", kGlsl, "highp float w", "mediump float w"},
    {".glsl", kGlsl, "highp float w", "precise float w"},
    {".glsl", kGlsl, "inout float y", "out float y"},
    {".glsl", kGlsl, "in float x", "inout float x"},
    {".glsl", "void f(coherent image2D a) { imageStore(a, ivec2(0), vec4(1)); }", "coherent image2D", "image2D"},
    {".glsl", "void f(readonly image2D a) { b = imageLoad(a, ivec2(0)); }", "readonly image2D", "volatile image2D"},
    // SYCL, and other words that change values
    {".dp.cpp", kSycl, "memory_order::relaxed", "memory_order::acq_rel"},
    {".dp.cpp", kSycl, "memory_scope::device", "memory_scope::work_group"},
    {".cpp", kMember, "virtual float f", "float f"},
    {".cpp", kC, "float f(", "INLINED_TARGET float f("},
    {".cpp", kC, "float f(", "INLINE(avx) float f("},
    {".cpp", kC, "float f(", "__attribute__((optimize(\"fast-math\"))) float f("},
    {".cpp", kC, "float f(", "[[noreturn]] float f("},  // what follows a call of it is gone
    {".cpp", kC, "float f(", "__attribute__((target(\"fma\"))) float f("},
    {".cpp", kC, "unsigned int k", "int k"},
    {".cpp", kC, "unsigned int k", "unsigned short k"},
    {".cpp", kC, "(float)k", "(double)k"},
    {".cpp", kC, "(float)k", "reinterpret_cast<float&>(k)"},
    {".c", kC, "0.0f", "0.0"},
    {".cpp", kMember, "const S* q = static_cast<const S*>(p)", "S q = *static_cast<const S*>(p)"},
    {".cpp", kMember, "f(S s,", "f(S& s,"},
};

/// The findings of the edit that weigh at least a warning; its file alone is edited.
std::vector<std::string> rules_after(const LabelledEdit& edit, const std::string& rules) {
    const bool is_entry = edit.suffix == ".comp" && edit.text.find("main()") != std::string::npos;
    const bool is_member = edit.text.find("S::f") != std::string::npos;
    const std::string name = is_entry ? "main" : is_member ? "S::f" : "f", source = "s/k" + edit.suffix;
    MemoryDisk disk;
    disk.files = {
        {"/r/" + source, edit.text},
        {"/r/t/k.cpp", "float f(float x) {\n    return x * 3.0f + 1.0f;\n}\n"},
        {"/r/portmap.toml", "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n[[pair]]\nsource = \"" +
                                source + ":" + name + "\"\ntarget = \"t/k.cpp:f\"\n" + rules}};
    const CommandRun recorded = run(disk, {"-C", "/r", "init", "--force"});
    EXPECT_EQ(recorded.exit_code, 0) << recorded.err;
    disk.files["/r/" + source] = replaced(edit.text, edit.from, edit.to);
    std::vector<std::string> out;
    const auto report = check(disk);
    for (const auto& finding : report["findings"])
        if (finding["level"] != "note" && finding["rule"] != "unported") out.push_back(finding["rule"]);
    return out;
}

std::string shown(const LabelledEdit& edit) { return edit.suffix + ": " + edit.from + " -> " + edit.to; }

TEST(LoneEdit, WhatChangesNoValueRaisesNothingUnlessAskedFor) {
    using Rules = std::vector<std::string>;
    EXPECT_GE(kSilent.size(), 60u);
    for (const LabelledEdit& edit : kSilent) {
        EXPECT_EQ(rules_after(edit, ""), Rules{}) << shown(edit);
        EXPECT_EQ(rules_after(edit, "[rules]\nqualifiers = \"warning\"\n"), Rules{"qualifiers"}) << shown(edit);
    }
}

TEST(LoneEdit, WhatCanChangeAValueIsFound) {
    EXPECT_GE(kHarmful.size(), 60u);
    for (const LabelledEdit& edit : kHarmful)
        EXPECT_EQ(rules_after(edit, ""), std::vector<std::string>{"source-changed"}) << shown(edit);
}

const std::string kSpelled = R"(
typedef struct Sum { float x; int n; } Sum;
float f(const float a[], int n, float s, Sum* p, half h, Matrix m, Matrix r, const volatile float* v) {
    float sum = 0.0f, best = 1e-3f;
    int count = 0, last;
    last = n;
    for (int i = 0; i < n; i++) {
        if (a[i] > s) { sum += a[i] * s; count = count + 1; }
    }
    if (p != NULL && count != 0) { p->x = sum; p->n += 1; }
    float t = (sum + best) * 2.0f - (sum - best - s);
    while (count > 1) { count >>= 1; h = h + 1; }
    if (count == 0 || !(t > s)) return a[n - 1] < s ? s : a[n - 1] > t ? t : a[0];
    m *= r; r = m * r;
    return sum + (best + t) * s;
}
)";

/// What C, and with it OpenCL and CUDA, says of the two spellings: the same value in every bit.
const std::vector<std::pair<std::string, std::string>> kRespelled = {
    {"count = count + 1", "count += 1"},
    {"count = count + 1", "count++"},
    {"count = count + 1", "++count"},
    {"sum += a[i] * s", "sum = sum + a[i] * s"},
    {"sum += a[i] * s", "sum += s * a[i]"},
    {"sum += a[i] * s", "sum += (s * (a[i]))"},
    {"count >>= 1", "count = count >> 1"},
    {"a[i] > s", "s < a[i]"},
    {"a[i] > s", "*(a + i) > s"},
    {"count > 1", "1 < count"},
    {"p != NULL", "p"},
    {"p != NULL", "p != 0"},
    {"p != NULL", "NULL != p"},
    {"count != 0", "count"},
    {"count == 0", "!count"},
    {"count == 0", "0 == count"},
    {"count == 0", "!(count != 0)"},
    {"p->x = sum", "(*p).x = sum"},
    {"p->x = sum", "p[0].x = sum"},
    {"(sum + best) * 2.0f", "2.0f * (best + sum)"},
    {"(sum + best) * 2.0f", "((sum + best) * 2.0f)"},
    {"float t = (sum + best) * 2.0f", "float t; t = (sum + best) * 2.0f"},
    {"float sum = 0.0f, best = 1e-3f;", "float sum = 0.0f; float best = 1e-3f;"},
    {"int count = 0, last;\n    last = n;", "int count = 0;\n    int last = n;"},
    {"while (count > 1)", "for (; count > 1;)"},
    {"a[n - 1] < s ? s : a[n - 1] > t ? t : a[0]", "(a[n - 1] < s) ? s : ((a[n - 1] > t) ? t : a[0])"},
    {"const float a[]", "const float* a"},
};

/// Near them, and not the same, or not to be known so: sums that are grouped otherwise, what is not a plain number.
const std::vector<std::pair<std::string, std::string>> kNotRespelled = {
    {"sum + (best + t) * s", "(sum + best + t) * s"},
    {"sum + best", "sum - best"},
    {"(sum - best - s)", "(sum - (best - s))"},
    {"(sum - best - s)", "sum - best - s"},
    {"a[i] > s", "s > a[i]"},
    {"a[i] > s", "!(a[i] <= s)"},
    {"count != 0", "!count"},
    {"count != 0", "count != 1"},
    {"p != NULL && count != 0", "p != NULL || count != 0"},
    {"count = count + 1", "count = count + 2"},
    {"count = count + 1", "n = count + 1"},
    {"p->n += 1", "p->n = p->n + 1"},
    {"p->x = sum", "p[1].x = sum"},
    {"m *= r", "m = m * r"},
    {"r = m * r", "r = r * m"},
    {"int count = 0, last;\n    last = n;", "int count = n, last;\n    last = 0;"},
    {"const float a[]", "const float** a"},
    {"const volatile float* v", "const float* v"},
    {"return sum + (best", "return sum + s + (best"},
    {"!(t > s)", "!t > s"},
};

TEST(LoneEdit, WhatSpellsAStatementOtherwiseRaisesNothing) {
    for (const auto& [from, to] : kRespelled) {
        const LabelledEdit there{".cl", kSpelled, from, to}, back{".cl", replaced(kSpelled, from, to), to, from};
        EXPECT_EQ(rules_after(there, ""), std::vector<std::string>{}) << shown(there);
        if (kSpelled.find(to) == std::string::npos) {
            EXPECT_EQ(rules_after(back, ""), std::vector<std::string>{}) << shown(back);
        }
    }
    const LabelledEdit one{".cl", kSpelled, kRespelled[0].first, kRespelled[0].second};
    EXPECT_EQ(rules_after(one, "[rules]\nqualifiers = \"warning\"\n"), std::vector<std::string>{"qualifiers"});
}

TEST(LoneEdit, WhatIsNearAnotherSpellingIsFound) {
    const std::string kStream = "void f(Stream& out, Range r, int n) {\n    out << g(n);\n    n > g(n);\n}\n";
    for (const auto& [from, to] : {std::pair("out << g(n)", "out >> g(n)"), std::pair("n > g(n)", "n >= g(n)")})
        EXPECT_NE(rules_after({".cpp", kStream, from, to}, ""), std::vector<std::string>{}) << to;
    for (const auto& [from, to] : kNotRespelled) {
        const LabelledEdit edit{".cl", kSpelled, from, to};
        EXPECT_NE(rules_after(edit, ""), std::vector<std::string>{}) << shown(edit);
    }
}

/// Spellings that look alike and are not: what a stranger found, each with the values that part.
const std::vector<std::pair<std::string, std::string>> kTraps = {
    {"y = k++;", "y = ++k;"},
    {"k = z->n--;", "k = --z->n;"},
    {"p[i] = k++;", "p[i] = ++k;"},
    {"for (; k < n; i = k++) y = k;", "for (; k < n; i = ++k) y = k;"},
    {"*p++;", "(*p)++;"},
    {"y = *p++;", "y = (*p)++;"},
    {"r = (float)(c ? i : u);", "r = c ? (float)i : (float)u;"},
    {"int t = c ? i : s; use(t);", "int t = c ? i : (int)s; use(t);"},
    {"r = (real_t)-i / n;", "r = (real_t)-(i / n);"},
    {"r = (real_t)-i % n + b;", "r = (real_t)-(i % n) + b;"},
    {"r = z->n = s;", "z->n = r = s;"},
    {"int m[2][2]; r = m[0][1] = s;", "int m[2][2]; m[0][1] = r = s;"},
    {"y = SQ(s + b);", "y = SQ((s + b));"},
    {"y = SQ(s + b);", "y = SQ(b + s);"},
    {"y = (N) * 2;", "y = N * 2;"},
    {"r = s - (N);", "r = s - N;"},
    {"r = s - (N * i);", "r = s - N * i;"},
    {"CHECK(i + n);", "CHECK(n + i);"},
    {"float t = (float)d * d; use(t);", "float t = d * d; use(t);"},
    {"real t = (float)d * i; use(t);", "real t = d * (float)i; use(t);"},
    {"float t = sqrt(s) * b; use(t);", "float t = (float)sqrt(s) * b; use(t);"},
    {"r = expf(s) * __expf(b);", "r = __expf(s) * expf(b);"},
    {"r = s * b + r * a[i];", "r = r * a[i] + s * b;"},
    {"v = v ^ w;", "v = w ^ v;"},
    {"v = v * w;", "v = w * v;"},
    {"v *= w;", "v = v * w;"},
    {"r = !m ? a[0] : b;", "r = m ? b : a[0];"},
    {"r = (m && c) ? a[0] : b;", "r = m ? (c ? a[0] : b) : b;"},
    {"std::optional<int*> x = h(); if (x != nullptr) y = 1;", "std::optional<int*> x = h(); if (x) y = 1;"},
    {"int t = bool(i) + bool(n); use(t);", "int t = bool(bool(i) + bool(n)); use(t);"},
};

TEST(LoneEdit, WhatOnlyLooksLikeAnotherSpellingIsFound) {
    for (const char* suffix : {".cpp", ".cl", ".cu"})
        for (const auto& [from, to] : kTraps) {
            const std::string text =
                "void f(const float* a, int i, int n, int k, int y, unsigned u, float s, float b, float r, bool c, "
                "int* p, S* z, double d, Vec4f v, Vec4f w, int4 m) {\n    " +
                from + "\n    use(y, r, k, u, v);\n}\n";
            const LabelledEdit there{suffix, text, from, to}, back{suffix, replaced(text, from, to), to, from};
            EXPECT_NE(rules_after(there, ""), std::vector<std::string>{}) << shown(there);
            EXPECT_NE(rules_after(back, ""), std::vector<std::string>{}) << shown(back);
        }
    for (const auto& [suffix, from, to] : {std::tuple(".cpp", "float a[][3]", "float* a[3]"),
                                           std::tuple(".ispc", "uniform float a[]", "uniform float* a")}) {
        const std::string text = "void f(" + std::string(from) + ", int n) {\n    n = 0;\n}\n";
        EXPECT_NE(rules_after({suffix, text, from, to}, ""), std::vector<std::string>{}) << to;
    }
}

TEST(LoneEdit, AStructIsItsFieldsHoweverItIsNamed) {
    const std::string body = "typedef struct { float x, y; int n; } f;\n";
    for (const char* now : {"typedef struct f { float x; float y; int n; } f;", "struct f { float x, y; int n; };"})
        EXPECT_EQ(rules_after({".cl", body, "typedef struct { float x, y; int n; } f;", now}, ""),
                  std::vector<std::string>{})
            << now;
    for (const char* now : {"typedef struct { float y, x; int n; } f;", "typedef union { float x, y; int n; } f;",
                            "typedef struct __attribute__((packed)) { float x, y; int n; } f;"})
        EXPECT_NE(rules_after({".cl", body, "typedef struct { float x, y; int n; } f;", now}, ""),
                  std::vector<std::string>{})
            << now;
}

TEST(LoneEdit, BracesAroundAStatementThatChoosesAreCosmetic) {
    const std::string body = R"(
float f(float a, float b, int n) {
    float x = 0.0f;
    if (n > 1) x = a > b ? a : b;
    if (n > 2)
        if (n > 3) x += a > 0.0f ? b : n > 4 ? a : 1.0f;
        else x -= b > 0.0f ? a : b;
    for (int i = 0; i < n; ++i) x = x > a ? x - b : a;
    x *= b;
    return x;
}
)";
    const std::string one = "if (n > 1) x = a > b ? a : b;", loop = "x = x > a ? x - b : a;";
    const std::string inner = "if (n > 3) x += a > 0.0f ? b : n > 4 ? a : 1.0f;", other = "else x -= b > 0.0f ? a : b;";
    const std::vector<LabelledEdit> cosmetic = {
        {".cl", body, one, "if (n > 1) { x = a > b ? a : b; }"},
        {".cl", body, loop, "{ " + loop + " }"},
        {".cl", body, inner, "if (n > 3) { x += a > 0.0f ? b : n > 4 ? a : 1.0f; }"},
        {".cl", body, other, "else { x -= b > 0.0f ? a : b; }"},
        {".cl", body, inner + "\n        " + other, "{ " + inner + " " + other + " }"},
    };
    for (const LabelledEdit& edit : cosmetic)
        EXPECT_EQ(rules_after(edit, ""), std::vector<std::string>{}) << shown(edit);
    // The inner `else` becomes that of the outer `if`; what follows a loop is drawn into it.
    const std::string outer = replaced(body, inner, "{ " + inner + " }");
    const std::vector<std::string> found = {"source-changed"};
    EXPECT_EQ(rules_after({".cl", body, inner, "{ " + inner + " }"}, ""), found);
    EXPECT_EQ(rules_after({".cl", outer, "{ " + inner + " }", inner}, ""), found);
    EXPECT_EQ(rules_after({".cl", body, loop + "\n    x *= b;", "{ " + loop + "\n    x *= b; }"}, ""), found);
    EXPECT_EQ(rules_after({".cl", body, "a > b ? a : b", "a > b ? b : a"}, ""), found);
}

struct RowsOfEdits {
    std::string suffix, text;
    std::vector<std::pair<std::string, std::string>> same, other;
};

const std::vector<RowsOfEdits> kVectorEdits = {
    {".cl",
     R"(
typedef struct { float s0, s1, r, x; } Item;
float f(const float4 c, Item m, __global float4* o, int n) {
    float4 s = (float4)(0.0f), u = (float4)(1.0f, 2.0f, 3.0f, -0.0f);
    s.w = 1.0f; s.xyz = c.xyw; u.x = m.s0 + m.r;
    o[n] = s * u;
    return 0.2f * c.x + read_imagef(a, b).x;
}
)",
     {{"c.x +", "c.s0 +"},
      {"s.w = 1", "s.s3 = 1"},
      {"s.w = 1", "s.S3 = 1"},
      {"c.xyw", "c.s013"},
      {"s.xyz", "s.rgb"},
      {"b).x", "b).s0"},
      {"(0.0f)", "(0.0f, 0.0f, 0.0f, 0.0f)"},
      {"(0.0f)", "(0)"},
      {"(1.0f, 2.0f, 3.0f", "(1, 2.0f, 3"}},
     {{"c.x +", "c.s1 +"},
      {"c.x +", "c.y +"},
      {"c.xyw", "c.s031"},
      {"c.xyw", "c.yxw"},
      {"s.w = 1", "s.s2 = 1"},
      {"m.s0 +", "m.x +"},
      {"m.r;", "m.x;"},
      {"(0.0f)", "(0.0f, 0.0f, 0.0f, 1.0f)"},
      {"(0.0f)", "(0.5f)"},
      {"-0.0f", "-0"},
      {"-0.0f", "0.0f"},
      {"1.0f, 2.0f", "2.0f, 1.0f"}}},
    {".glsl",
     R"(
struct Item { float r; float x; };
void f(vec3 p, Item m, ivec2 at) {
    vec3 n = imageLoad(image, at).xyz * 2.0;
    vec3 u, v = p;
    ivec2 z = ivec2(0);
    float a = imageLoad(image, at).r + load(at).r + m.r, t[2];
    t[0] = p.x; t[1] = p.y; u.z = a;
    write(z, vec4(n, 1.0), mat3(1.0), vec3(a), uvec2(1u, 1u));
}
)",
     {{").xyz", ").rgb"},
      {"at).r + load", "at).x + load"},
      {"at).r + load", "at)[0] + load"},
      {"ivec2(0)", "ivec2(0, 0)"},
      {"p.y", "p[1]"},
      {"p.y", "p.t"},
      {"u.z", "u.b"},
      {"vec4(n, 1.0)", "vec4(n, 1)"},
      {"vec3(a)", "vec3(a, a, a)"},
      {"uvec2(1u, 1u)", "uvec2(1)"}},
     {{").xyz", ").rbg"},
      {").xyz", ").zyx"},
      {"at).r + load", "at).y + load"},
      {"load(at).r", "load(at).x"},
      {"+ m.r", "+ m.x"},
      {"ivec2(0)", "ivec2(0, 1)"},
      {"ivec2(0)", "ivec2(1)"},
      {"p.y", "p[2]"},
      {"t[1] =", "t[0] ="},
      {"vec4(n, 1.0)", "vec4(n, 0.0)"},
      {"vec4(n, 1.0)", "vec4(n, 1.5)"},
      {"mat3(1.0)", "mat3(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0)"},
      {"vec3(a)", "vec3(a, a, 0.0)"},
      {"vec3(a)", "vec3(next(), next(), next())"}}},
    {".metal",
     R"(
kernel void f(device float4* o [[buffer(0)]], uint i [[thread_position_in_grid]]) {
    float4 s = float4(0);
    s.rgb = o[i].xyz;
    o[i] = s * float4(0.5) + half4(2049);
}
)",
     {{"float4(0)", "float4(0.0)"},
      {"float4(0)", "float4(0, 0, 0, 0)"},
      {"s.rgb", "s.xyz"},
      {"float4(0.5)", "float4(0.5, 0.5, 0.5, 0.5)"},
      {"kernel void f", "[[kernel]] void f"}},
     {{"float4(0)", "float4(0, 0, 0, 1)"},
      {"float4(0)", "float4(1)"},
      {"float4(0.5)", "float4(0)"},
      {"s.rgb", "s.xzy"},
      {"o[i].xyz", "o[i].xzy"},
      {"half4(2049)", "half4(2050)"},
      {"kernel void f", "[[vertex]] void f"}}},
    {".cpp",
     R"(
#include <sycl/sycl.hpp>
struct Item { float w() const; float operator[](int i) const; };
float f(sycl::float4 v, const sycl::vec<float, 4>& u, Item m) {
    return v.w() + u[0] + m.w() + dot(sycl::float4(0.0f), v) + length(float4(0));
}
)",
     {{"v.w()", "v[3]"}, {"u[0]", "u.x()"}, {"sycl::float4(0.0f)", "sycl::float4(0.0f, 0.0f, 0.0f, 0.0f)"}},
     {{"v.w()", "v[2]"},
      {"v.w()", "v.z()"},
      {"u[0]", "u.y()"},
      {"m.w()", "m[3]"},
      {"(float4(0))", "(float4(0, 0, 0, 0))"},
      {"sycl::float4(0.0f)", "sycl::float4(0.0f, 0.0f, 0.0f, 1.0f)"}}},
    // A name that is a vector in one block and something else in another is nothing in particular.
    {".glsl",
     "struct Item { float r; float x; };\n"
     "float f(int n) {\n    { vec3 a = load(n); use(a.x); }\n    Item a = item(n);\n    return a.r;\n}\n",
     {},
     {{"return a.r", "return a.x"}}},
    {".cpp",
     "float f(int n) {\n    float4 a = float4(0);\n    return a.x + float4(n)[1];\n}\n",
     {},
     {{"float4(0)", "float4(0, 0, 0, 0)"}, {"float4(0)", "float4(0.0f)"}}},
};

const std::vector<RowsOfEdits> kHeadEdits = {
    {".glsl",
     "void f(in vec3 p, inout float y, out float z) {\n    y = p.x; z = y;\n}\n",
     {{"in vec3 p", "const in vec3 p"}, {"in vec3 p", "const vec3 p"}},
     {{"in vec3 p", "inout vec3 p"}, {"in vec3 p", "out vec3 p"}}},
    {".comp",
     "layout(local_size_x = 8, local_size_y = 4) in;\nvoid main() {\n    total += gl_LocalInvocationIndex;\n}\n",
     {{"local_size_y = 4", "local_size_y = 4, local_size_z = 1"},
      {"local_size_x = 8", "local_size_z = 1, local_size_x = 8"},
      {"void main", "layout(local_size_z = 1) in;\nvoid main"},
      {"void main", "layout(local_size_x = 8) in;\nvoid main"},
      {", local_size_y = 4) in;", ") in;\nlayout(local_size_y = 4) in;"}},
     {{"void main", "layout(local_size_z = 2) in;\nvoid main"},
      {", local_size_y = 4) in;", ") in;\nlayout(local_size_y = 2) in;"},
      {"void main", "layout(row_major) uniform;\nvoid main"},
      {"layout(local_size_x = 8, local_size_y = 4) in;", ""},
      {"local_size_y = 4", "local_size_y = 4, local_size_z = 2"},
      {", local_size_y = 4", ""},
      {", local_size_y = 4", ", local_size_y = 1"},
      {"local_size_x = 8", "local_size_x = 1"}}},
    {".cpp",
     "float g(float x);\nfloat f(float x) { return x * 2.0f; }\n",
     {{"float g", "float f(float);\nfloat g"},
      {"float g", "float f(float) __attribute__((noinline, unused));\nfloat g"},
      {"float g", "[[nodiscard]] float f(float);\nfloat g"},
      {"float g", "[[gnu::always_inline, deprecated(\"no\")]] float f(float);\nfloat g"},
      {"float g", "__attribute__((__visibility__(\"hidden\"))) float f(float);\nfloat g"},
      {"float g(float x)", "__attribute__((weak)) float g(float x)"},
      {"float g", "#pragma clang attribute push(__attribute__((noinline)), apply_to = function)\nfloat g"},
      {"float g",
       "#pragma clang attribute push(__attribute__((weak)), apply_to = function)\n#pragma clang attribute pop\nfloat "
       "g"}},
     {{"float g", "float f(float) __attribute__((optimize(\"fast-math\")));\nfloat g"},
      {"float g", "__attribute__((weak)) float f(float);\nfloat g"},
      {"float g", "__attribute__((noinline, __weak__)) float f(float);\nfloat g"},
      {"float g", "[[gnu::weak]] float f(float);\nfloat g"},
      {"float g", "[[nodiscard]] [[gnu::target(\"fma\")]] float f(float);\nfloat g"},
      {"float g", "namespace n { float f(float) __attribute__((unheard_of)); }\nfloat g"},
      {"float g", "#pragma clang attribute push(__attribute__((weak)), apply_to = function)\nfloat g"}}},
    {".cpp",
     "float f(float) __attribute__((target(\"sse4\")));\nfloat f(float x) { return x * 2.0f; }\n",
     {{"float f(float)", "float f(float y)"}, {"float f(float)", "extern float f(float)"}},
     {{"sse4", "fma"}, {" __attribute__((target(\"sse4\")))", ""}}},
    {".cpp",
     "#pragma GCC optimize(\"O3\")\nfloat f(float x) { return x * 2.0f; }\n",
     {{"pragma GCC", "pragma  GCC"}},
     {{"O3", "fast-math"}}},
    {".cu",
     "__global__ void __launch_bounds__(128, 4) f(float* a) { a[threadIdx.x] = 1.0f; }\n",
     {{"__global__ void __launch_bounds__(128, 4)", "__global__ __launch_bounds__(128, 4) void"},
      {"__global__ void __launch_bounds__(128, 4)", "__launch_bounds__(128, 4) __global__ void"}},
     {{"__global__ void __launch_bounds__(128, 4)", "__launch_bounds__(128, 2) __global__ void"},
      {"__global__ void __launch_bounds__(128, 4)", "__global__ void"}}},
    {".cl",
     "__kernel void f(__global float4* a) { a[get_global_id(0)] = a[0] * 2.0f; }\n",
     {{"__kernel void", "__kernel __attribute__((vec_type_hint(float4))) void"}},
     {{"__kernel void", "__kernel __attribute__((reqd_work_group_size(64, 1, 1))) void"}}},
    {".ispc",
     "inline float f(float x, uniform float y) {\n    return x * y;\n}\n",
     {{"inline float f", "noinline float f"}},
     {{"inline float f", "unmasked float f"}}},
    {".cuh",
     "struct f { float x; int n; };\n",
     {{"struct f {", "struct f final {"}},
     {{"struct f {", "struct __align__(16) f {"}, {"float x; int n;", "int n; float x;"}}},
};

TEST(LoneEdit, PartsOfVectorsAndHeadsAreSpelledInManyWays) {
    for (const std::vector<RowsOfEdits>& all : {kVectorEdits, kHeadEdits})
        for (const auto& [suffix, text, same, other] : all) {
            for (const auto& [from, to] : same) {
                const LabelledEdit there{suffix, text, from, to}, back{suffix, replaced(text, from, to), to, from};
                EXPECT_EQ(rules_after(there, ""), std::vector<std::string>{}) << shown(there);
                EXPECT_EQ(rules_after(back, ""), std::vector<std::string>{}) << shown(back);
            }
            for (const auto& [from, to] : other) {
                const LabelledEdit there{suffix, text, from, to};
                EXPECT_EQ(rules_after(there, ""), std::vector<std::string>{"source-changed"}) << shown(there);
            }
        }
}

}  // namespace
}  // namespace porttool::testing::lone_edit_test
