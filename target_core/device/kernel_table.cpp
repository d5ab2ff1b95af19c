// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/device/kernel_table.h"

#include "target_core/kernels/kernels.h"

namespace target_core {

const KernelTable one_lane_kernels = {"1 lane",          1,
                                      kernels::generate, kernels::extend,
                                      kernels::shade,    kernels::connect,
                                      kernels::finalize, kernels::guide,
                                      kernels::filter,   kernels::reproject};

KernelTables runnable_kernels() {
    KernelTables found{};
#ifdef TARGET_CORE_16_LANES
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512bw")) {
        found.tables[found.count++] = &avx512_kernels;
    }
#endif
#ifdef TARGET_CORE_8_LANES
    if (__builtin_cpu_supports("avx2")) {
        found.tables[found.count++] = &avx2_kernels;
    }
#endif
    found.tables[found.count++] = &one_lane_kernels;
    return found;
}

}  // namespace target_core
