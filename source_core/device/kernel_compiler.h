// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "source_core/device/exact_arithmetic.h"
#include "source_core/device/vulkan_status.h"

namespace source_core {

/// Compiles the compute kernel `name` (a key of `files`, which also resolves its includes) to SPIR-V for Vulkan 1.2.
/// `preamble` is read right after the #version line. Every float arithmetic result is decorated with NoContraction,
/// every storage buffer with what the kernel does to it (spirv_passes.h); `arithmetic` is spelled out as it says.
/// Fails with internal and the compiler's first messages, each with file and line.
Result<std::vector<uint32_t>> compile_kernel(const std::map<std::string, std::string>& files, const std::string& name,
                                             const std::string& preamble, const ExactArithmetic& arithmetic);

}  // namespace source_core
