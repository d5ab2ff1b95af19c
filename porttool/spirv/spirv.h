// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "porttool/spirv/shader_files.h"

namespace porttool {

/// An entry point as SPIR-V, in two forms to compare, or why there is none.
struct SpirvModule {
    std::vector<uint32_t> stripped;  ///< without names, debug information and functions that are never called
    std::vector<uint32_t> reduced;   ///< and without code that has no effect; what is left computes as before
    std::string error;               ///< the compiler's first message
};

/// False where porttool was built without glslang and SPIRV-Tools.
bool spirv_is_built_in();

/// Compiles an entry point (a path with a stage's suffix) for Vulkan, else for OpenGL. `preamble` is read right after
/// its #version line; includes are found as find_include() says. Throws CannotDo for one that takes too much memory,
/// and ends the process where one takes too long (CompileLimit).
SpirvModule compile_to_spirv(const ShaderFiles& files, const std::string& entry,
                             const std::vector<std::string>& include, const std::string& preamble);

}  // namespace porttool
