// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Pairing of code that was not written as twins: names spelled by other habits, roles that only the calls tell.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "porttool/match/compounds.h"
#include "porttool/match/match.h"
#include "porttool/match/words.h"
#include "porttool/scan/scan.h"

namespace porttool::match_unlike_test {
namespace {

using Texts = std::vector<std::pair<std::string, std::string>>;
using Ids = std::vector<std::pair<std::string, std::string>>;

std::vector<ScannedFile> scanned(const Texts& texts) {
    std::vector<ScannedFile> out;
    for (const auto& [path, text] : texts) out.push_back(scan_text(path, text));
    return out;
}

Ids paired(const Texts& source, const Texts& target) {
    Ids out;
    for (const MatchedPair& pair : match_units(scanned(source), scanned(target), {}, Dialect()).pairs)
        out.emplace_back(pair.source, pair.target);
    return out;
}

bool has(const Ids& ids, const std::string& source, const std::string& target) {
    return std::find(ids.begin(), ids.end(), std::pair(source, target)) != ids.end();
}

TEST(Names, APlatformBeforeOrBehindANameIsNoPartOfIt) {
    for (const char* name : {"Forward_gpu", "Forward_cpu", "cuda_Forward", "ForwardGPU", "Forward_gpu_cuda"})
        EXPECT_EQ(without_platform(name), "Forward") << name;
    for (const char* name : {"copy_to_gpu", "gpu", "is_cpu", "run_on_gpu", "metallic", "chip", "cpufreq"})
        EXPECT_EQ(without_platform(name), name);
}

TEST(Names, WhatIsOneWordSomewhereIsOneWordEverywhere) {
    const auto source = scanned({{"batchnorm.comp", "void main() { }"}, {"prelu.comp", "void main() { }"}});
    const auto target = scanned({{"layers.cpp", "void BatchNorm::forward() { }\nvoid PReLU::forward() { }\n"}});
    const Compounds compounds(source, target);
    EXPECT_EQ(compounds.split("BatchNorm::forward"), compounds.split("batchnorm_forward"));
    EXPECT_EQ(compounds.split("PReLU"), split_words("prelu"));
    EXPECT_EQ(compounds.split("BatchSize"), split_words("batch_size"));  // nobody spells it together
    EXPECT_EQ(split_words("Conv2D"), split_words("conv_2d"));
}

/// One of many layers: a kernel, what launches it, and the method of the other side that does both.
std::string kernel_of(const std::string& name, const std::string& step) {
    return "__global__ void " + name + step + "(const int n, const float* in, float* out) {\n" +
           "  int i = threadIdx.x; if (i < n) out[i] = in[i] * " + std::to_string(name.size()) + ".5f + " +
           std::to_string(step.size()) + ";\n}\n" + "void " + name + "Layer::" + step + "_gpu(Blobs& top) {\n  " +
           name + step + "<<<1, 64>>>(top.count(), top.gpu_data(), top.mutable_gpu_data());\n}\n";
}

std::string method_of(const std::string& name, const std::string& step) {
    return "void " + name + "Layer::" + step + "_cpu(Blobs& top) {\n  for (int i = 0; i < top.count(); ++i)\n" +
           "    top.mutable_cpu_data()[i] = top.cpu_data()[i] * " + std::to_string(name.size()) + ".5f + " +
           std::to_string(step.size()) + ";\n}\n";
}

TEST(Unlike, NamesThatDifferInThePlatformTheyNameAreOne) {
    Texts source, target;
    Ids expected;
    for (const std::string name : {"Relu", "Sigmoid", "Dropout", "Softmax", "Scale", "Tile", "Slice"}) {
        source.emplace_back("gpu/" + name + ".cu", "");
        target.emplace_back("cpu/" + name + ".cpp", "void " + name + "Layer::Reshape(Blobs& top) { top.reshape(); }\n");
        for (const std::string step : {"Forward", "Backward"}) {
            source.back().second += kernel_of(name, step);
            target.back().second += method_of(name, step);
            const std::string port = "cpu/" + name + ".cpp:" + name + "Layer::" + step + "_cpu";
            expected.emplace_back("gpu/" + name + ".cu:" + name + step, port);
            expected.emplace_back("gpu/" + name + ".cu:" + name + "Layer::" + step + "_gpu", port);
        }
    }
    Ids found = paired(source, target);
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
}

TEST(Unlike, AStoreThroughAMacroIsWork) {
    // Were it none, these would be the idle helpers of a file whose kernels work.
    const std::string left =
        "int predict_8x8_ddl(const pixel* src, const pixel* top) {\n  pixel pred[32];\n"
        "  for (int y = 0; y < 4; y++)\n    for (int x = 0; x < 8; x++)\n"
        "      pred[x + y * 8] = (2 + top[x + y] + 2 * top[x + y + 1] + top[x + y + 2]) >> 2;\n"
        "  return satd(src, pred);\n}\n"
        "int predict_8x8_hu(const pixel* src, const pixel* left) {\n  pixel pred[32];\n"
        "  for (int y = 0; y < 4; y++) pred[y] = (left[y] + 2 * left[y + 1] + left[y + 2] + 2) >> 2;\n"
        "  return satd(src, pred);\n}\n";
    const std::string right =
        "static void predict_8x8_ddl_c(pixel* src, pixel edge[36]) {\n  LOAD_TOP\n"
        "  SRC(0, 0) = F2(t0, t1, t2);\n  SRC(0, 1) = SRC(1, 0) = F2(t1, t2, t3);\n  SRC(7, 7) = F2(t14, t15, "
        "t15);\n}\n"
        "static void predict_8x8_hu_c(pixel* src, pixel edge[36]) {\n  LOAD_LEFT\n"
        "  SRC(0, 0) = F1(l0, l1);\n  SRC(1, 0) = F2(l0, l1, l2);\n  SRC(7, 7) = F2(l7, l7, l7);\n}\n";
    EXPECT_EQ(paired({{"opencl/intra.cl", left}}, {{"common/predict.c", right}}),
              (Ids{{"opencl/intra.cl:predict_8x8_ddl", "common/predict.c:predict_8x8_ddl_c"},
                   {"opencl/intra.cl:predict_8x8_hu", "common/predict.c:predict_8x8_hu_c"}}));
}

TEST(Unlike, AKernelThatHandsOnIsPortedByWhatPortsTheFunctionItCalls) {
    const std::string left =
        "template <typename T> __device__ void unpack_q4(const void* x, T* y, int lane) {\n"
        "  const block_q4* b = (const block_q4*)x; const float d = b->d;\n"
        "  for (int j = 0; j < 8; ++j) y[8 * lane + j] = d * (b->qs[8 * lane + j] & 15) - 8 * d;\n}\n"
        "template <typename T> __global__ void unpack_block_q4(const void* x, T* y) {\n"
        "  const int i = blockIdx.x;\n  unpack_q4(x, y + i, threadIdx.x);\n}\n";
    const std::string right =
        "void unpack_row_q4(const block_q4* x, float* y, int k) {\n  for (int i = 0; i < k / 32; i++) {\n"
        "    const float d = x[i].d;\n    for (int j = 0; j < 32; ++j) y[32 * i + j] = d * (x[i].qs[j] & 15) - 8 * "
        "d;\n  }\n}\n"
        "void pack_row_q4(const float* x, block_q4* y, int k) { for (int i = 0; i < k; i++) y[i].d = x[i]; }\n";
    EXPECT_EQ(paired({{"cuda/convert.cu", left}}, {{"cpu/quants.c", right}}),
              (Ids{{"cuda/convert.cu:unpack_block_q4", "cpu/quants.c:unpack_row_q4"},
                   {"cuda/convert.cu:unpack_q4", "cpu/quants.c:unpack_row_q4"}}));
}

TEST(Unlike, WhatMakesReadyIsNoKernelsPort) {
    Texts shaders, layers;
    Ids expected;
    for (const std::string name : {"clip", "relu", "mish", "swish", "erf", "gelu"}) {
        const std::string own = std::to_string(static_cast<int>(name[0])) + ".5";
        shaders.emplace_back("shader/" + name + ".comp",
                             "void main() { uint i = gl_GlobalInvocationID.x; if (i >= n) return;\n"
                             "  float v = data[i]; data[i] = clamp(v * " +
                                 own + ", low, high); }\n");
        layers.emplace_back(
            "layer/" + name + ".cpp",
            "int " + name + "::load_param(const Params& p) { low = p.get(0); high = p.get(1); return 0; }\n" + "int " +
                name + "::forward_inplace(Mat& data) const {\n  for (int i = 0; i < n; i++) {\n" +
                "    float v = data[i] * " + own + ";\n    if (v < low) v = low;\n" +
                "    if (v > high) v = high;\n    data[i] = v;\n  }\n  return 0;\n}\n");
        expected.emplace_back("shader/" + name + ".comp:main", "layer/" + name + ".cpp:" + name + "::forward_inplace");
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(paired(shaders, layers), expected);
}

TEST(Unlike, AShadersMainIsPortedInTheFileOfItsName) {
    Texts shaders, layers;
    Ids expected;
    for (const std::string name : {"sigmoid", "clip", "mish", "swish", "erf", "gelu"}) {
        const std::string value = "1.f / (" + std::to_string(static_cast<int>(name[0])) + ".5f + exp(-data[i]))";
        shaders.emplace_back(
            "shader/" + name + ".comp",
            "void main() { uint i = gl_GlobalInvocationID.x; if (i >= n) return; data[i] = " + value + "; }\n");
        layers.emplace_back("layer/" + name + ".cpp", "int " + name + "::forward_inplace(Mat& data) const {\n" +
                                                          "  for (int i = 0; i < n; i++) data[i] = " + value +
                                                          ";\n  return 0;\n}\n");
        expected.emplace_back("shader/" + name + ".comp:main", "layer/" + name + ".cpp:" + name + "::forward_inplace");
    }
    layers.emplace_back("layer/detect.cpp",
                        "static inline float sigmoid(float x) { return 1.f / (1.f + expf(-x)); }\n"
                        "int Detect::forward(const Mat& in, Mat& out) const {\n"
                        "  for (int i = 0; i < n; i++) out[i] = sigmoid(in[i]) * scale;\n  return 0;\n}\n");
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(paired(shaders, layers), expected);
}

TEST(Unlike, WhatNotesAnOperationIsNotThePortOfWhatLaunchesIt) {
    const std::string cuda =
        "static __global__ void scale_f32(const float* x, float* y, float s, int n) {\n"
        "  int i = threadIdx.x; if (i < n) y[i] = s * x[i]; }\n"
        "static void scale_f32_cuda(const float* x, float* y, float s, int n) { scale_f32<<<1, n>>>(x, y, s, n); }\n"
        "void lib_cuda_op_scale(context& ctx, tensor* dst) {\n  const tensor* src = dst->src[0];\n"
        "  check(src->type == F32);\n  scale_f32_cuda(src->data, dst->data, dst->params[0], src->count);\n}\n";
    const std::string builder =
        "tensor* lib_scale(context* ctx, tensor* a, float s) {\n  tensor* result = lib_dup_tensor(ctx, a);\n"
        "  set_params(result, &s, sizeof(s));\n  result->op = OP_SCALE;\n  result->src[0] = a;\n  return result;\n}\n";
    const std::string cpu =
        "static void lib_compute_scale_f32(const params* p, tensor* dst) {\n  const tensor* src = dst->src[0];\n"
        "  for (int i = 0; i < src->count; i++) dst->data[i] = dst->params[0] * src->data[i];\n}\n";
    const Ids ids = paired({{"cuda/scale.cu", cuda}}, {{"lib.c", builder}, {"cpu/ops.cpp", cpu}});
    EXPECT_TRUE(has(ids, "cuda/scale.cu:scale_f32", "cpu/ops.cpp:lib_compute_scale_f32"));
    EXPECT_FALSE(has(ids, "cuda/scale.cu:lib_cuda_op_scale", "lib.c:lib_scale"));
}

TEST(Unlike, WhatSetsAKernelsArgumentsIsNotItsPortWhateverItStores) {
    const std::string kernel =
        "kernel void Blur(__global float4* in, __global float4* out, int width, float radius) {\n"
        "  const int i = get_global_id(0);\n  float4 sum = 0; float weight = 0;\n"
        "  for (int x = -3; x <= 3; x++) { const float w = radius - fabs((float)x); sum += in[i + x] * w; weight += w; "
        "}\n"
        "  out[i] = sum / weight;\n}\n";
    const std::string host =
        "bool EngineRenderBlur::Render(Image* image) {\n  for (int i = 0; i < image->width; i++) buffer[i] = "
        "image->At(i);\n"
        "  if (!AssignParametersToKernel(0)) return false;\n  if (!ProcessQueue(image->width)) return false;\n"
        "  for (int i = 0; i < image->width; i++) image->Put(i, buffer[i]);\n  return true;\n}\n";
    const std::string cpu =
        "void PostEffectBlur::Apply(const Pixel* in, Pixel* out, int width, float radius) {\n"
        "  for (int i = 0; i < width; i++) {\n    Pixel sum; float weight = 0;\n"
        "    for (int x = -3; x <= 3; x++) { const float w = radius - fabs((float)x); sum += in[i + x] * w; weight += "
        "w; }\n"
        "    out[i] = sum / weight;\n  }\n}\n";
    const Ids ids =
        paired({{"opencl/blur.cl", kernel}}, {{"src/engine_render_blur.cpp", host}, {"src/post_effect_blur.cpp", cpu}});
    EXPECT_EQ(ids, (Ids{{"opencl/blur.cl:Blur", "src/post_effect_blur.cpp:PostEffectBlur::Apply"}}));
}

TEST(Unlike, WhatCallsAKernelByItsNameIsNotItsPort) {
    const std::string kernels =
        "export void noise_ispc(uniform float out[], uniform int n) {\n"
        "  foreach (i = 0 ... n) { float x = i * 0.01; out[i] = x * x * (3.0 - 2.0 * x) + 0.5 * x; }\n}\n";
    const std::string serial =
        "void noise_serial(float out[], int n) {\n"
        "  for (int i = 0; i < n; ++i) { float x = i * 0.01f; out[i] = x * x * (3.0f - 2.0f * x) + 0.5f * x; }\n}\n";
    const std::string caller =
        "int main() {\n  float* out = new float[100];\n  noise_ispc(out, 100);\n  noise_serial(out, 100);\n"
        "  for (int i = 0; i < 100; ++i) out[i] = 0;\n  return 0;\n}\n";
    EXPECT_EQ(
        paired({{"noise/noise.ispc", kernels}}, {{"noise/noise.cpp", caller}, {"noise/noise_serial.cpp", serial}}),
        (Ids{{"noise/noise.ispc:noise_ispc", "noise/noise_serial.cpp:noise_serial"}}));
}

TEST(Unlike, BranchesOfAnIfAreNoOverloads) {
    const std::string left =
        "#if DEPTH == 8\nstatic inline quantum clamp_to_quantum(const float v) { return (quantum)clamp(v, 0.0f, "
        "kRange); }\n"
        "#else\nstatic inline quantum clamp_to_quantum(const float v) { return (quantum)(clamp(v, 0.0f, kRange) + "
        "0.5f); }\n"
        "#endif\n";
    const std::string right =
        "static inline Quantum clamp_to_quantum(const real_type quantum) {\n  if (quantum <= 0.0) return 0;\n"
        "  if (quantum >= kRange) return kRange;\n  return (Quantum)(quantum + 0.5);\n}\n"
        "static inline Quantum scale_char(const unsigned char v) { return (Quantum)(257.0 * v); }\n";
    EXPECT_EQ(paired({{"kernels.cl", left}}, {{"quantum.h", right}}),
              (Ids{{"kernels.cl:clamp_to_quantum", "quantum.h:clamp_to_quantum"},
                   {"kernels.cl:clamp_to_quantum#2", "quantum.h:clamp_to_quantum"}}));
}

TEST(Unlike, OverloadsThatDifferInTemplateArgumentsAreNoBranches) {
    const std::string left =
        "__device__ void mma(tile<16, 8, int>& d, const tile<16, 4, int>& a) { d.x[0] = a.x[0] * 2; d.x[1] = a.x[1]; "
        "}\n"
        "__device__ void mma(tile<16, 8, float>& d, const tile<16, 8, half>& a) { d.x[0] = a.x[0]; d.x[1] = 0.5f; }\n"
        "__device__ void mma(tile<8, 8, half>& d, const tile<8, 4, half>& a) { d.x[0] = a.x[1]; d.x[2] = a.x[3]; }\n";
    const std::string right =
        "void mma(volatile float* d[4], const unsigned a[4]) { for (int i = 0; i < 4; i++) *d[i] = a[i]; }\n";
    EXPECT_LT(paired({{"cuda/mma.cuh", left}}, {{"sycl/helper.hpp", right}}).size(), 2u);
}

TEST(Unlike, WhatLaunchesIsPortedByWhatHandsOnToALambda) {
    const auto cuda = [](const std::string& name, const std::string& sum) {
        return "__global__ void " + name +
               "_f32(const float* x, float* y, int n) {\n  int i = threadIdx.x; if (i < n) y[i] = " + sum +
               "; }\nvoid lib_cuda_op_" + name + "(context& ctx, tensor* dst) {\n  const tensor* src = dst->src[0];\n" +
               "  check(src->type == F32);\n  const int blocks = (src->count + 255) / 256;\n  " + name +
               "_f32<<<blocks, 256>>>(src->data, dst->data, src->count);\n}\n";
    };
    const auto sycl = [](const std::string& name, const std::string& sum) {
        return "static void " + name + "_f32_sycl(const float* x, float* y, int n, sycl::queue* stream) {\n" +
               "  stream->parallel_for(sycl::range<1>(n), [=](sycl::id<1> i) { if (i < n) y[i] = " + sum +
               "; });\n}\n" + "void lib_sycl_op_" + name +
               "(context& ctx, tensor* dst) {\n  const tensor* src = dst->src[0];\n" +
               "  check(src->type == F32);\n  " + name +
               "_f32_sycl(src->data, dst->data, src->count, ctx.stream());\n}\n";
    };
    Texts source, target;
    for (const auto& [name, sum] :
         Texts{{"square", "x[i] * x[i]"}, {"halve", "0.5f * x[i]"}, {"shift", "x[i] + 3.0f"}}) {
        source.emplace_back("cuda/" + name + ".cu", cuda(name, sum));
        target.emplace_back("sycl/" + name + ".cpp", "#include <sycl/sycl.hpp>\n" + sycl(name, sum));
    }
    const Ids ids = paired(source, target);
    for (const std::string name : {"square", "halve", "shift"})
        EXPECT_TRUE(has(ids, "cuda/" + name + ".cu:lib_cuda_op_" + name, "sycl/" + name + ".cpp:lib_sycl_op_" + name))
            << name;
}

TEST(Unlike, AVersionOfAFunctionHasItsPort) {
    const auto solver = [](const std::string& name, const std::string& step) {
        return "__global__ void " + name + "(float* y, const float* k, int n) {\n  float error = 0, scale = 1;\n" +
               "  for (int i = 0; i < n; i++) {\n    y[i] = y[i] + " + step + " * k[i] * scale;\n" +
               "    error += fabsf(k[i]) / (1e-6f + fabsf(y[i]));\n    if (error > 1) scale = scale * 0.5f;\n  }\n}\n";
    };
    const std::string port =
        "void solver(float* y, const float* k, int n) {\n  float error = 0, scale = 1;\n"
        "  for (int i = 0; i < n; i++) {\n    y[i] = y[i] + 0.25f * k[i] * scale;\n"
        "    error += fabsf(k[i]) / (1e-6f + fabsf(y[i]));\n    if (error > 1) scale = scale * 0.5f;\n  }\n}\n";
    EXPECT_EQ(
        paired({{"cuda/solver.cu", solver("solver", "0.25f")}, {"cuda/solver_2.cu", solver("solver_2", "0.5f")}},
               {{"omp/solver.c", port}}),
        (Ids{{"cuda/solver.cu:solver", "omp/solver.c:solver"}, {"cuda/solver_2.cu:solver_2", "omp/solver.c:solver"}}));
}

TEST(Unlike, ABodyThatIsWrittenLikeNoOtherOutweighsAnotherVerb) {
    const std::string body =
        "  int ipiv[4] = {0, 0, 0, 0};\n  for (int i = 0; i < 4; ++i) {\n    int row = -1; float big = 0;\n"
        "    for (int j = 0; j < 4; ++j)\n      if (ipiv[j] != 1 && fabs(m->a[j][i]) >= big) { big = fabs(m->a[j][i]); "
        "row = j; }\n"
        "    ++ipiv[row];\n    for (int k = 0; k < 4; ++k) m->a[i][k] = m->a[i][k] / big;\n  }\n";
    const std::string others =
        "float Matrix_trace(const Matrix* m) { return m->a[0][0] + m->a[1][1] + m->a[2][2]; }\n"
        "void Matrix_transpose(Matrix* m) { float t = m->a[0][1]; m->a[0][1] = m->a[1][0]; m->a[1][0] = t; }\n";
    EXPECT_TRUE(has(paired({{"cl/matrix.cl", "void Matrix_invert(Matrix* m) {\n" + body + "}\n" + others}},
                           {{"cpp/matrix.cpp", "void Matrix_inverse(Matrix* m) {\n" + body + "}\n" + others}}),
                    "cl/matrix.cl:Matrix_invert", "cpp/matrix.cpp:Matrix_inverse"));
}

}  // namespace
}  // namespace porttool::match_unlike_test
