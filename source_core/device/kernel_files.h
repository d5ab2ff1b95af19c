// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "source_core/device/kernel_set.h"

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

/// Those of the texts that a kernel is compiled from: its own and all that this includes.
std::map<std::string, std::string> texts_of_kernel(const std::map<std::string, std::string>& files, Kernel kernel);

}  // namespace source_core
