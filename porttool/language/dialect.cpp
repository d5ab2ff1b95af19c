// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/language/dialect.h"

#include <algorithm>
#include <array>

#include "porttool/language/word_list.h"
#include "porttool/language/words.h"

namespace porttool {
namespace {

/// A common name and, separated by blanks, what says the same elsewhere.
struct DialectRow {
    std::string_view name;
    std::string_view equivalents;
};

// Types.
constexpr std::array kTypes = {
    DialectRow{"vec2", "float2 Vec2f vector_float2 make_float2 cl_float2 packed_float2 Vec2fa"},
    DialectRow{"vec3",
               "float3 Vec3f Vec3fa Vec3ff Vector Vector3f Vector3 Point Normal Point3f Normal3f vector_float3 "
               "make_float3 cl_float3 "
               "packed_float3 make_Vec3f make_Vec3fa Vector3D V3f"},
    DialectRow{"vec4", "float4 Vec4f Vector4f vector_float4 make_float4 cl_float4 packed_float4 make_Vec4f V4f"},
    DialectRow{"ivec2", "int2 Vec2i make_int2 vector_int2 cl_int2"},
    DialectRow{"ivec3", "int3 Vec3i make_int3 vector_int3 cl_int3"},
    DialectRow{"ivec4", "int4 Vec4i make_int4 vector_int4 cl_int4"},
    DialectRow{"uvec2", "uint2 Vec2ui make_uint2 vector_uint2 cl_uint2"},
    DialectRow{"uvec3", "uint3 Vec3ui make_uint3 vector_uint3 cl_uint3"},
    DialectRow{"uvec4", "uint4 Vec4ui make_uint4 vector_uint4 cl_uint4"},
    DialectRow{"mat3", "float3x3 LinearSpace3f LinearSpace3fa"},
    DialectRow{"mat4", "float4x4 Matrix4x4 AffineSpace3f AffineSpace3fa Transform"},
    DialectRow{"uint", "u_int uint32_t unsigned uint32 u32 cl_uint GLuint"},
    DialectRow{"int", "int32_t int32 i32 cl_int signed"},
    // `int8` is a vector of eight in OpenCL, and has eight bits in ISPC.
    DialectRow{"int8_t", "cl_char"},
    DialectRow{"uint8_t", "u_char uchar byte cl_uchar"},
    DialectRow{"short", "int16_t cl_short"},
    DialectRow{"uint16_t", "u_short ushort cl_ushort"},
    DialectRow{"uint64", "uint64_t u_longlong ulonglong ulong u_int64 cl_ulong"},
    DialectRow{"int64", "int64_t longlong cl_long"},
    DialectRow{"half", "float16_t f16 half_t __half"},
    DialectRow{"bfloat16", "__nv_bfloat16 nv_bfloat16 hip_bfloat16 __hip_bfloat16"},
    DialectRow{"half2", "f16vec2 __half2"},
    DialectRow{"size_t", "u_size_t std_size_t"},
    DialectRow{"float", "float32_t f32 real Float cl_float"},
    DialectRow{"double", "cl_double"},
    DialectRow{"nullptr", "NULL"},
    DialectRow{"bool", "_Bool boolean"},
    DialectRow{"sampler2D", "texture2d Texture2D image2d_t texture2D"},
};

// Built-in functions and variables.
constexpr std::array kBuiltIns = {
    DialectRow{"mix", "lerp Lerp"},
    DialectRow{"fract", "frac fracf"},
    DialectRow{"inversesqrt", "rsqrt rsqrtf native_rsqrt"},
    DialectRow{"sqrt", "sqrtf native_sqrt __fsqrt_rn"},
    DialectRow{"abs", "Abs"},
    DialectRow{"fabs", "fabsf"},
    DialectRow{"min", "fmin fminf Min fast_min std_min"},
    DialectRow{"max", "fmax fmaxf Max fast_max std_max"},
    DialectRow{"clamp", "Clamp clampf"},
    DialectRow{"saturate", "__saturatef Saturate"},
    DialectRow{"mod", "Mod"},
    DialectRow{"fmod", "fmodf"},
    DialectRow{"pow", "powf native_powr __powf powr"},
    DialectRow{"exp", "expf __expf native_exp"},
    DialectRow{"exp2", "exp2f native_exp2"},
    DialectRow{"log", "logf __logf native_log"},
    DialectRow{"log2", "log2f native_log2 __log2f"},
    DialectRow{"sin", "sinf __sinf native_sin"},
    DialectRow{"cos", "cosf __cosf native_cos"},
    DialectRow{"sincos", "sincosf __sincosf"},
    DialectRow{"tan", "tanf native_tan"},
    DialectRow{"asin", "asinf"},
    DialectRow{"acos", "acosf"},
    DialectRow{"atan", "atanf atan2 atan2f"},
    DialectRow{"sinh", "sinhf"},
    DialectRow{"cosh", "coshf"},
    DialectRow{"tanh", "tanhf"},
    DialectRow{"asinh", "asinhf"},
    DialectRow{"acosh", "acoshf"},
    DialectRow{"atanh", "atanhf"},
    DialectRow{"sinpi", "sinpif"},
    DialectRow{"cospi", "cospif"},
    DialectRow{"exp10", "exp10f __exp10f native_exp10"},
    DialectRow{"expm1", "expm1f"},
    DialectRow{"log10", "log10f __log10f native_log10"},
    DialectRow{"log1p", "log1pf"},
    DialectRow{"cbrt", "cbrtf"},
    DialectRow{"rcbrt", "rcbrtf"},
    DialectRow{"hypot", "hypotf"},
    DialectRow{"erf", "erff"},
    DialectRow{"erfc", "erfcf"},
    DialectRow{"tgamma", "tgammaf"},
    DialectRow{"lgamma", "lgammaf"},
    DialectRow{"copysign", "copysignf"},
    DialectRow{"ldexp", "ldexpf"},
    DialectRow{"fdim", "fdimf"},
    DialectRow{"remainder", "remainderf"},
    DialectRow{"nextafter", "nextafterf"},
    DialectRow{"floor", "floorf"},
    DialectRow{"Floor2Int", "Floor2UInt"},
    DialectRow{"ceil", "ceilf"},
    DialectRow{"round", "roundf"},
    DialectRow{"rint", "rintf nearbyint"},
    DialectRow{"trunc", "truncf"},
    DialectRow{"dot", "Dot"},
    DialectRow{"cross", "Cross"},
    DialectRow{"length", "Length"},
    DialectRow{"normalize", "Normalize fast_normalize"},
    DialectRow{"reflect", "Reflect"},
    DialectRow{"fma", "fmaf"},
    DialectRow{"mad", ""},
    DialectRow{"floatBitsToUint", "__float_as_uint float_as_uint as_uint asuint"},
    DialectRow{"floatBitsToInt", "__float_as_int float_as_int as_int asint"},
    DialectRow{"intBitsToFloat",
               "__int_as_float int_as_float uintBitsToFloat __uint_as_float uint_as_float as_float asfloat"},
    DialectRow{"bitCount", "__popc popcount popcnt countbits"},
    DialectRow{"findLSB", "ctz firstbitlow"},
    DialectRow{"ffs", "__ffs"},
    DialectRow{"findMSB", "firstbithigh"},
    DialectRow{"clz", "__clz"},
    DialectRow{"atomicAdd",
               "atomic_add atomic_inc AtomicAdd AtomicInc InterlockedAdd fetch_add atomic_fetch_add "
               "atomic_fetch_add_explicit"},
    DialectRow{"atomicSub", "atomic_sub atomic_dec"},
    DialectRow{"atomicExchange", "atomicExch atomic_xchg InterlockedExchange"},
    DialectRow{"atomicAnd", "atomic_and InterlockedAnd"},
    DialectRow{"atomicOr", "atomic_or InterlockedOr"},
    DialectRow{"atomicXor", "atomic_xor InterlockedXor"},
    DialectRow{"atomicMin", "atomic_min InterlockedMin fetch_min"},
    DialectRow{"atomicMax", "atomic_max InterlockedMax fetch_max"},
    DialectRow{"atomicCompSwap", "atomicCAS atomic_cmpxchg InterlockedCompareExchange"},
    DialectRow{"barrier", "__syncthreads GroupMemoryBarrierWithGroupSync threadgroup_barrier group_barrier"},
    DialectRow{"shuffleXor",
               "__shfl_xor_sync subgroupShuffleXor permute_group_by_xor permute_sub_group_by_xor simd_shuffle_xor"},
    DialectRow{"shuffleDown", "__shfl_down_sync subgroupShuffleDown shift_group_left simd_shuffle_down"},
    DialectRow{"subgroupAdd", "warp_reduce_sum reduce_over_group simd_sum WaveActiveSum"},
    DialectRow{"local_id", "threadIdx gl_LocalInvocationID get_local_id SV_GroupThreadID"},
    DialectRow{"group_id", "blockIdx gl_WorkGroupID get_group_id get_group SV_GroupID"},
    DialectRow{"group_size", "blockDim gl_WorkGroupSize get_local_size get_local_range"},
    DialectRow{"group_count", "gridDim gl_NumWorkGroups get_num_groups get_group_range"},
    DialectRow{"global_id", "gl_GlobalInvocationID get_global_id get_global_linear_id SV_DispatchThreadID"},
    DialectRow{"texture", "tex2D tex2Dlod texture2D textureLod read_imagef SampleLevel"},
    DialectRow{"texelFetch", "tex1Dfetch"},
    DialectRow{"traceRay", "optixTrace traceRayEXT rtcIntersect1 rtcIntersect TraceRay"},
    DialectRow{"pi", "PI M_PI M_PI_F M_PIf CL_M_PI kPi"},
    DialectRow{"inv_pi", "INVPI INV_PI M_1_PI M_1_PI_F one_over_pi"},
    DialectRow{"two_pi", "TWOPI TWO_PI M_2PI"},
    DialectRow{"infinity", "INFINITY INF inf pos_inf"},
    DialectRow{".", "->"},
};

// Functions that take each other's place in ports, and so help to pair units, but give other values: the remainder of
// negatives, halves, the number of a bit, ...
constexpr std::array kAlike = {
    DialectRow{"abs", "fabs"},        DialectRow{"mod", "fmod"},         DialectRow{"round", "rint Round2Int"},
    DialectRow{"floor", "Floor2Int"}, DialectRow{"ceil", "Ceil2Int"},    DialectRow{"findLSB", "ffs"},
    DialectRow{"findMSB", "clz"},     DialectRow{"infinity", "FLT_MAX"}, DialectRow{"fma", "mad"},
    DialectRow{"int8_t", "int8"},     DialectRow{"uint8_t", "uint8"},    DialectRow{"short", "int16"},
    DialectRow{"uint16_t", "uint16"},
};

/// The name under which units are paired.
std::string_view paired_name(std::string_view name) {
    std::string_view paired = name;
    for (const DialectRow& row : kAlike)
        for_each_word(row.equivalents, [&](std::string_view word) {
            if (word == name) paired = row.name;
        });
    return paired;
}

}  // namespace

Dialect::Dialect(const std::vector<std::pair<std::string, std::string>>& rows) {
    auto add = [&](std::string_view words, std::string_view name) {
        for_each_word(words, [&](std::string_view word) {
            meanings_.emplace(word, name);
            names_.emplace(word, paired_name(name));
        });
    };
    auto add_table = [&](const auto& table) {
        for (const DialectRow& row : table) {
            add(row.name, row.name);
            add(row.equivalents, row.name);
        }
    };
    for (const auto& [left, right] : rows) {  // a person's rows come first and so win
        const std::string* known = meaning(left);
        const bool dropped = word_is(left, kDropped) || word_is(right, kDropped);  // "OUR_INLINE" = "inline"
        const std::string name = dropped ? "" : known != nullptr ? *known : left;
        add(left, name);
        add(right, name);
    }
    add_table(kTypes);
    add_table(kBuiltIns);
    for (const std::string_view word : {"Round2Int", "Ceil2Int", "FLT_MAX", "int8", "uint8", "int16", "uint16"})
        add(word, word);
    for (const std::string_view word : words_with(kDropped)) add(word, "");
}

bool Dialect::is_number_type(std::string_view name) const {
    if (const std::string* known = meaning(name); known != nullptr && !known->empty()) name = *known;
    return word_is(name, kNumberType) ||
           std::any_of(kTypes.begin(), kTypes.end(), [&](const DialectRow& row) { return row.name == name; });
}

const std::string* Dialect::meaning(std::string_view word) const {
    const auto found = meanings_.find(word);
    return found == meanings_.end() ? nullptr : &found->second;
}

const std::string* Dialect::find(std::string_view word) const {
    const auto found = names_.find(word);
    return found == names_.end() ? nullptr : &found->second;
}

void Dialect::add_counterparts(const std::vector<std::pair<std::string, std::string>>& names) {
    for (const auto& [source, target] : names) {
        counterparts_.emplace(target, source);
        with_counterpart_.insert(source);
    }
}

const std::string* Dialect::counterpart(std::string_view target_name) const {
    const auto found = counterparts_.find(target_name);
    return found == counterparts_.end() ? nullptr : &found->second;
}

}  // namespace porttool
