// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "source_core/device/vulkan_status.h"

namespace source_core {

/// One kernel file as it was when the program was built.
struct EmbeddedKernel {
    std::string_view name;
    std::string_view text;
};

/// All files of kernels/, made by the build.
extern const EmbeddedKernel EMBEDDED_KERNELS[];
extern const unsigned EMBEDDED_KERNEL_COUNT;

/// The texts of all kernel files by name: those built in, or those in `directory` where it is not empty. Fails with
/// not_found if the directory or a file that the program needs is not there.
Result<std::map<std::string, std::string>> read_kernel_files(const std::string& directory);

/// The names of those that the kernels of the program are compiled from: their own files and all that these include.
std::vector<std::string> files_that_run(const std::map<std::string, std::string>& files);

}  // namespace source_core
