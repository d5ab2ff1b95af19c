// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/language/sister_runtime.h"

#include <array>

namespace porttool {
namespace {

constexpr std::array kSisterNames = {
    SisterName{"cudaDeviceProp", "hipDeviceProp_t", true},
    SisterName{"cudaDeviceAttr", "hipDeviceAttribute_t", true},
    SisterName{"cudaLimit", "hipLimit_t", true},
    SisterName{"cudaFuncCache", "hipFuncCache_t", true},
    SisterName{"cudaFreeHost", "hipHostFree", true},
    SisterName{"cudaHostAlloc", "hipHostMalloc", false},
    SisterName{"cudaMallocHost", "hipHostMalloc", false},
    SisterName{"cudaHostAllocDefault", "hipHostMallocDefault", true},
    SisterName{"cudaHostAllocMapped", "hipHostMallocMapped", true},
    SisterName{"cudaHostAllocPortable", "hipHostMallocPortable", true},
    SisterName{"cudaHostAllocWriteCombined", "hipHostMallocWriteCombined", true},
    SisterName{"cudaThreadSynchronize", "hipDeviceSynchronize", false},
};

}  // namespace

const SisterName* sister_name(std::string_view word) {
    // The usual name of cudaDeviceSynchronize.
    if (word == "hipDeviceSynchronize") return nullptr;
    for (const SisterName& row : kSisterNames)
        if (word == row.cuda || word == row.hip) return &row;
    return nullptr;
}

}  // namespace porttool
