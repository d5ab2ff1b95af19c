// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/language/language.h"

#include <algorithm>
#include <array>
#include <string>

namespace porttool {
namespace {

struct SuffixRow {
    std::string_view suffix;
    Language language;
};

constexpr std::array kSuffixes = {
    SuffixRow{".dp.cpp", Language::Sycl}, SuffixRow{".dp.hpp", Language::Sycl},  SuffixRow{".sycl", Language::Sycl},
    SuffixRow{".hip.cpp", Language::Hip}, SuffixRow{".hip.h", Language::Hip},    SuffixRow{".hip", Language::Hip},
    SuffixRow{".cu", Language::Cuda},     SuffixRow{".cuh", Language::Cuda},     SuffixRow{".cl", Language::OpenCl},
    SuffixRow{".clh", Language::OpenCl},  SuffixRow{".ocl", Language::OpenCl},   SuffixRow{".glsl", Language::Glsl},
    SuffixRow{".comp", Language::Glsl},   SuffixRow{".vert", Language::Glsl},    SuffixRow{".frag", Language::Glsl},
    SuffixRow{".geom", Language::Glsl},   SuffixRow{".tesc", Language::Glsl},    SuffixRow{".tese", Language::Glsl},
    SuffixRow{".rgen", Language::Glsl},   SuffixRow{".rchit", Language::Glsl},   SuffixRow{".rmiss", Language::Glsl},
    SuffixRow{".rahit", Language::Glsl},  SuffixRow{".rint", Language::Glsl},    SuffixRow{".rcall", Language::Glsl},
    SuffixRow{".mesh", Language::Glsl},   SuffixRow{".task", Language::Glsl},    SuffixRow{".vs", Language::Glsl},
    SuffixRow{".fs", Language::Glsl},     SuffixRow{".glslh", Language::Glsl},   SuffixRow{".vsh", Language::Glsl},
    SuffixRow{".fsh", Language::Glsl},    SuffixRow{".gsh", Language::Glsl},     SuffixRow{".hlsl", Language::Hlsl},
    SuffixRow{".hlsli", Language::Hlsl},  SuffixRow{".fx", Language::Hlsl},      SuffixRow{".fxh", Language::Hlsl},
    SuffixRow{".usf", Language::Hlsl},    SuffixRow{".ush", Language::Hlsl},     SuffixRow{".metal", Language::Metal},
    SuffixRow{".slang", Language::Slang}, SuffixRow{".slangh", Language::Slang}, SuffixRow{".ispc", Language::Ispc},
    SuffixRow{".isph", Language::Ispc},   SuffixRow{".c", Language::C},          SuffixRow{".h", Language::Cpp},
    SuffixRow{".hh", Language::Cpp},      SuffixRow{".hpp", Language::Cpp},      SuffixRow{".hxx", Language::Cpp},
    SuffixRow{".h++", Language::Cpp},     SuffixRow{".cpp", Language::Cpp},      SuffixRow{".cc", Language::Cpp},
    SuffixRow{".cxx", Language::Cpp},     SuffixRow{".c++", Language::Cpp},      SuffixRow{".inl", Language::Cpp},
    SuffixRow{".ipp", Language::Cpp},     SuffixRow{".tpp", Language::Cpp},      SuffixRow{".ixx", Language::Cpp},
    SuffixRow{".cppm", Language::Cpp},    SuffixRow{".impl", Language::Cpp},
};

bool contains_any(std::string_view text, std::initializer_list<std::string_view> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return text.find(word) != std::string_view::npos; });
}

}  // namespace

std::string_view language_name(Language language) {
    switch (language) {
        case Language::C:
            return "c";
        case Language::Cpp:
            return "cpp";
        case Language::Cuda:
            return "cuda";
        case Language::Hip:
            return "hip";
        case Language::Sycl:
            return "sycl";
        case Language::OpenCl:
            return "opencl";
        case Language::Glsl:
            return "glsl";
        case Language::Hlsl:
            return "hlsl";
        case Language::Metal:
            return "metal";
        case Language::Slang:
            return "slang";
        case Language::Ispc:
            return "ispc";
        case Language::Unknown:
            break;
    }
    return "unknown";
}

Language language_of_path(std::string_view path) {
    std::string lower(path.substr(path.find_last_of('/') + 1));
    std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
    for (const auto& row : kSuffixes)  // the longer suffixes stand first
        if (lower.ends_with(row.suffix)) return row.language;
    return Language::Unknown;
}

Language language_of_text(Language by_path, std::string_view path, std::string_view text) {
    if (by_path == Language::Cuda && contains_any(text, {"hip/hip_runtime.h", "hip_runtime.h>"})) return Language::Hip;
    if (by_path != Language::Cpp) return by_path;
    if (contains_any(text, {"sycl/sycl.hpp", "sycl::", "cl::sycl"})) return Language::Sycl;
    if (contains_any(text, {"hip/hip_runtime.h"})) return Language::Hip;
    const bool header = path.ends_with(".h") || path.ends_with(".hpp") || path.ends_with(".inl");
    if (!header) return by_path;
    if (contains_any(text, {"__global__ ", "__device__ "})) return Language::Cuda;
    if (contains_any(text, {"__kernel ", "get_global_id("})) return Language::OpenCl;
    return by_path;
}

}  // namespace porttool
