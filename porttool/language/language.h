// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace porttool {

/// The dialects that the scanner tells apart.
enum class Language { C, Cpp, Cuda, Hip, Sycl, OpenCl, Glsl, Hlsl, Metal, Slang, Ispc, Unknown };

/// The name in JSON: "c", "cpp", "cuda", "hip", "sycl", "opencl", "glsl", "hlsl", "metal", "slang", "ispc", "unknown".
std::string_view language_name(Language language);

/// The dialect that a path's suffix tells; Unknown for suffixes that are no source text.
Language language_of_path(std::string_view path);

/// Refines what the suffix tells by the text: a `.h` with `__global__` is CUDA, a `.cpp` that includes SYCL is SYCL.
Language language_of_text(Language by_path, std::string_view path, std::string_view text);

}  // namespace porttool
