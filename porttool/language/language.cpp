// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/language/language.h"

#include <algorithm>
#include <array>
#include <string>

#include "porttool/language/word_list.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

constexpr auto kShading = Literals::Shading;
constexpr auto kAfterLayout = InterfaceBlocks::AfterLayout, kAnyBlock = InterfaceBlocks::Any;

/// A language that has all of C++.
constexpr LanguageTraits with_cpp(LanguageTraits row) {
    row.std_library = row.c_libraries = row.references = row.pointers = row.macros = true;
    return row;
}

/// A language for kernels or shaders alone, with vectors of its own.
constexpr LanguageTraits of_devices(LanguageTraits row) {
    row.macros = row.vectors = row.is_of_devices = true;
    return row;
}

// One row a language, in the order of the enumeration.
constexpr std::array kLanguages = {
    LanguageTraits{.language = Language::C,
                   .name = "c",
                   .suffixes = ".c",
                   .parameters_before_body = true,
                   .c_libraries = true,
                   .pointers = true,
                   .macros = true},
    with_cpp({.language = Language::Cpp,
              .name = "cpp",
              .suffixes = ".h .hh .hpp .hxx .h++ .cpp .cc .cxx .c++ .inl .ipp .tpp .tcc .txx .ixx .cppm .impl",
              .blocks = kAfterLayout}),
    with_cpp({.language = Language::Cuda, .name = "cuda", .suffixes = ".cu .cuh"}),
    with_cpp({.language = Language::Hip, .name = "hip", .suffixes = ".hip.cpp .hip.h .hip"}),
    with_cpp({.language = Language::Sycl, .name = "sycl", .suffixes = ".dp.cpp .dp.hpp .sycl"}),
    of_devices({.language = Language::OpenCl, .name = "opencl", .suffixes = ".cl .clh .ocl", .pointers = true}),
    of_devices({.language = Language::Glsl,
                .name = "glsl",
                .suffixes = ".glsl .comp .vert .frag .geom .tesc .tese .rgen .rchit .rmiss .rahit .rint .rcall "
                            ".mesh .task .vs .fs .glslh .vsh .fsh .gsh",
                .literals = kShading,
                .blocks = kAnyBlock,
                .entry_point = "main"}),
    of_devices({.language = Language::Hlsl,
                .name = "hlsl",
                .suffixes = ".hlsl .hlsli .fx .fxh .usf .ush",
                .literals = kShading}),
    of_devices({.language = Language::Metal,
                .name = "metal",
                .suffixes = ".metal",
                .literals = kShading,
                .references = true,
                .pointers = true}),
    of_devices({.language = Language::Slang,
                .name = "slang",
                .suffixes = ".slang .slangh",
                .literals = kShading,
                .blocks = kAfterLayout}),
    LanguageTraits{.language = Language::Ispc,
                   .name = "ispc",
                   .suffixes = ".ispc .isph",
                   .literals = kShading,
                   .pointers = true,
                   .macros = true},
    // Its own vectors are called `color` and `point`; a `vector2` there is a header's struct.
    LanguageTraits{.language = Language::Osl,
                   .name = "osl",
                   .suffixes = ".osl",
                   .literals = kShading,
                   .macros = true,
                   .is_of_devices = true},
    LanguageTraits{.language = Language::Unknown, .name = "unknown", .blocks = kAfterLayout},
};

constexpr bool stand_in_order() {
    for (size_t i = 0; i < kLanguages.size(); ++i)
        if (static_cast<size_t>(kLanguages[i].language) != i) return false;
    return kLanguages.size() == static_cast<size_t>(Language::Unknown) + 1;
}
static_assert(stand_in_order());

bool contains_any(std::string_view text, std::initializer_list<std::string_view> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return text.find(word) != std::string_view::npos; });
}

}  // namespace

const LanguageTraits& traits_of(Language language) { return kLanguages[static_cast<size_t>(language)]; }

Language language_of_path(std::string_view path) {
    const std::string_view name = path.substr(path.find_last_of('/') + 1);
    Language found = Language::Unknown;
    if (name.find('.') == std::string_view::npos) return found;
    const std::string lower = in_small_letters(name);
    size_t longest = 0;
    for (const LanguageTraits& row : kLanguages)
        for_each_word(row.suffixes, [&](std::string_view suffix) {
            if (suffix.size() <= longest || !lower.ends_with(suffix)) return;
            longest = suffix.size();
            found = row.language;
        });
    return found;
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
