// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace porttool {

/// HIP has CUDA's run time under names that begin with `hip` for `cuda`, but for a few that are called otherwise:
/// `cudaDeviceProp` is `hipDeviceProp_t`. A row of those.
struct SisterName {
    std::string_view cuda, hip;
    bool is_only_one;  ///< of CUDA's names that HIP's stands for
};

/// The row of a name of either; nullptr for names that differ in their first letters alone, and for all others. Of
/// several rows of one of HIP's names the first.
const SisterName* sister_name(std::string_view word);

}  // namespace porttool
