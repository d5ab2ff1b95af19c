// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Stands in for spirv.cpp where there is no glslang.
#include "porttool/spirv/spirv.h"

namespace porttool {

bool spirv_is_built_in() { return false; }

SpirvModule compile_to_spirv(const ShaderFiles&, const std::string&, const std::vector<std::string>&,
                             const std::string&) {
    return {{}, {}, "this porttool was built without glslang"};
}

}  // namespace porttool
