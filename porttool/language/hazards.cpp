// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/language/hazards.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "porttool/language/word_list.h"

namespace porttool {
namespace {

using Languages = uint32_t;  ///< a bit each

template <class... Each>
constexpr Languages languages(Each... each) {
    return ((Languages{1} << static_cast<unsigned>(each)) | ...);
}

constexpr Languages kShadingLanguages = languages(Language::Glsl, Language::Hlsl, Language::Slang);
constexpr Languages kOthers = ~kShadingLanguages;

struct HazardRow {
    std::string_view calls;  ///< separated by blanks
    Languages some, others;  ///< it means one thing in these and another in those
    std::string_view subject, in_some, in_others;
};

constexpr std::array kHazards = {
    HazardRow{"pow powf __powf powr native_powr", kShadingLanguages, kOthers, "pow of a zero or negative base",
              "is undefined", "is defined"},
    HazardRow{"mod fmod fmodf", languages(Language::Glsl), ~languages(Language::Glsl), "the remainder of negatives",
              "has the sign of the divisor with mod", "has that of the dividend with fmod"},
    HazardRow{"min max fmin fmax fminf fmaxf", kShadingLanguages, kOthers, "min and max with a NaN",
              "give either argument", "give the other one with fmin and fmax"},
    HazardRow{"normalize fast_normalize", kShadingLanguages, kOthers, "normalize of a zero vector", "is undefined",
              "is NaN or zero"},
    HazardRow{"int uint int32_t uint32_t __float2int_rz __float2uint_rz convert_int convert_uint",
              languages(Language::Cuda, Language::Hip), ~languages(Language::Cuda, Language::Hip),
              "a float out of range", "saturates as an integer", "is an undefined integer"},
    HazardRow{"round rint roundf rintf", kShadingLanguages, kOthers, "the round of a half",
              "goes in any direction, or to the even", "goes away from zero, that of rint to the even"},
    HazardRow{"mad", languages(Language::OpenCl, Language::Hlsl), ~languages(Language::OpenCl, Language::Hlsl), "mad",
              "may round once or twice", "is spelled fma and rounds once, or a * b + c and rounds twice"},
    HazardRow{"fma fmaf", languages(Language::Glsl), ~languages(Language::Glsl), "fma",
              "may round twice where it is not precise", "rounds once"},
};

/// Built-ins that give one value, and what gives it fast and less exactly; each separated by blanks.
struct PrecisionRow {
    std::string_view exact, fast;
};

constexpr std::array kPrecisions = {
    PrecisionRow{"exp expf", "__expf native_exp half_exp"},
    PrecisionRow{"exp2 exp2f", "native_exp2 half_exp2"},
    PrecisionRow{"log logf", "__logf native_log half_log"},
    PrecisionRow{"log2 log2f", "__log2f native_log2 half_log2"},
    PrecisionRow{"sin sinf", "__sinf native_sin half_sin"},
    PrecisionRow{"cos cosf", "__cosf native_cos half_cos"},
    PrecisionRow{"exp10 exp10f", "__exp10f native_exp10 half_exp10"},
    PrecisionRow{"log10 log10f", "__log10f native_log10 half_log10"},
    PrecisionRow{"tan tanf", "__tanf native_tan half_tan"},
    PrecisionRow{"pow powf powr", "__powf native_powr half_powr"},
    PrecisionRow{"sqrt sqrtf __fsqrt_rn", "native_sqrt half_sqrt"},
    PrecisionRow{"rsqrt rsqrtf inversesqrt", "native_rsqrt half_rsqrt"},
    PrecisionRow{"sincos sincosf", "__sincosf"},
    PrecisionRow{"normalize", "fast_normalize"},
    PrecisionRow{"length", "fast_length"},
    PrecisionRow{"distance", "fast_distance"},
};

/// A language's name for a reader; "" for one that is not known.
std::string_view readable_name(Language language) {
    switch (language) {
        case Language::C:
            return "C";
        case Language::Cpp:
            return "C++";
        case Language::Cuda:
            return "CUDA";
        case Language::Hip:
            return "HIP";
        case Language::Sycl:
            return "SYCL";
        case Language::OpenCl:
            return "OpenCL";
        case Language::Glsl:
            return "GLSL";
        case Language::Hlsl:
            return "HLSL";
        case Language::Metal:
            return "Metal";
        case Language::Slang:
            return "Slang";
        case Language::Ispc:
            return "ISPC";
        case Language::Osl:
            return "OSL";
        case Language::Unknown:
            break;
    }
    return "";
}

bool calls(const std::vector<std::string>& statements, std::string_view name) {
    const std::string call = std::string(name) + "(";
    return std::any_of(statements.begin(), statements.end(), [&](const std::string& statement) {
        for (size_t at = statement.find(call); at != std::string::npos; at = statement.find(call, at + 1)) {
            const char before = at > 0 ? statement[at - 1] : ' ';
            const bool inside_word = before == '_' || before == '.' || (before >= '0' && before <= '9') ||
                                     (before >= 'a' && before <= 'z') || (before >= 'A' && before <= 'Z');
            if (!inside_word) return true;
        }
        return false;
    });
}

}  // namespace

std::vector<std::string> hazards_of(const std::vector<std::string>& gained, const std::vector<std::string>& lost,
                                    Language here, Language there) {
    std::vector<std::string> out;
    if (readable_name(here).empty() || readable_name(there).empty()) return out;
    for (const HazardRow& row : kHazards) {
        const auto is_in = [](Languages list, Language language) { return (list & languages(language)) != 0; };
        const bool as_some = is_in(row.some, here) && is_in(row.others, there);
        if (!as_some && !(is_in(row.others, here) && is_in(row.some, there))) continue;
        bool now = false, before = false;
        for_each_word(row.calls, [&](std::string_view word) {
            now = now || calls(gained, word);
            before = before || calls(lost, word);
        });
        if (!now || before) continue;
        const std::string some(readable_name(as_some ? here : there)), others(readable_name(as_some ? there : here));
        out.push_back(std::string(row.subject) + " " + std::string(row.in_some) + " in " + some + " and " +
                      std::string(row.in_others) + " in " + others);
    }
    return out;
}

std::vector<std::string> precision_hazards(const std::vector<std::string>& source_gained,
                                           const std::vector<std::string>& target_gained) {
    const auto called = [](const std::vector<std::string>& statements, std::string_view words) {
        std::string_view found;
        for_each_word(words, [&](std::string_view word) {
            if (found.empty() && calls(statements, word)) found = word;
        });
        return found;
    };
    std::vector<std::string> out;
    for (const PrecisionRow& row : kPrecisions) {
        const std::string_view source_exact = called(source_gained, row.exact),
                               source_fast = called(source_gained, row.fast),
                               target_exact = called(target_gained, row.exact),
                               target_fast = called(target_gained, row.fast);
        const bool source_is_exact = source_fast.empty() && target_exact.empty();
        const std::string_view here = source_is_exact ? source_exact : source_fast,
                               there = source_is_exact ? target_fast : target_exact;
        const bool other_way = source_exact.empty() && target_fast.empty();
        if (here.empty() || there.empty() || (!source_is_exact && !other_way)) continue;
        out.push_back(std::string(here) + " of the source is " + std::string(there) + " in the port, which is " +
                      (source_is_exact ? "less" : "more") + " exact");
    }
    return out;
}

}  // namespace porttool
