// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace porttool {

/// The dialects that the scanner tells apart. Each has a row in language.cpp, and words of its own in words.cpp.
enum class Language : uint8_t { C, Cpp, Cuda, Hip, Sycl, OpenCl, Glsl, Hlsl, Metal, Slang, Ispc, Osl, Unknown };

/// Shading: `1.0` is a float and `abs` is for floats too (GLSL, HLSL, ...), so that no suffix tells one number or
/// function from another. C: as in C's family.
enum class Literals : uint8_t { Shading, C };

/// Whether variables come in named blocks: `uniform Camera {`, or only with `layout(...)` before it.
enum class InterfaceBlocks : uint8_t { None, AfterLayout, Any };

/// What sets a language apart, beyond its words.
struct LanguageTraits {
    Language language = Language::Unknown;
    std::string_view name = {};      ///< in JSON
    std::string_view suffixes = {};  ///< of its files, separated by blanks; the longest that fits a path counts
    Literals literals = Literals::C;
    InterfaceBlocks blocks = InterfaceBlocks::None;
    std::string_view entry_point = {};    ///< the name that makes a function a kernel; "": words say so
    bool parameters_before_body = false;  ///< as C had them before prototypes: `int add(a, b) int a; int b; {`
    bool std_library = false;             ///< that of C++
    bool c_libraries = false;             ///< what a library of C or C++ has may be called from its host code
    bool references = false;              ///< `T&`, and templates, as C++ has them
    bool pointers = false;                ///< `T*`
    bool macros = false;                  ///< `#define`
    bool vectors = false;                 ///< of its own: their parts have names for colours, too, `dot` is a function
    bool is_of_devices = false;           ///< for kernels or shaders alone; many of these have no `double`
};

const LanguageTraits& traits_of(Language language);

/// The dialect that a path's suffix tells; Unknown for suffixes that are no source text.
Language language_of_path(std::string_view path);

/// Refines what the suffix tells by the text: a `.h` with `__global__` is CUDA, a `.cpp` that includes SYCL is SYCL.
Language language_of_text(Language by_path, std::string_view path, std::string_view text);

}  // namespace porttool
