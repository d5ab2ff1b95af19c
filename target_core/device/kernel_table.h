// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "target_core/device/glsl.h"

namespace target_core {

/// The kernels as compiled for one kind of lanes. All tables compute the same bits; each kernel runs over all jobs of
/// the tile bound to this thread.
struct KernelTable {
    const char* name;
    uint lanes;  // of the widest of them
    void (*generate)();
    void (*extend)();
    void (*shade)();
    void (*connect)();
    void (*finalize)();
    void (*guide)();
    void (*filter)();
    void (*reproject)();
};

/// The bit-exact reference, and the only one that runs under exact mode's Embree callbacks.
extern const KernelTable one_lane_kernels;

// Where TARGET_CORE_LANES has them built (CMakeLists.txt).
extern const KernelTable avx2_kernels;
extern const KernelTable avx512_kernels;

/// The tables that this CPU can run, fastest first; the last is one_lane_kernels.
struct KernelTables {
    const KernelTable* tables[3];
    uint count;
};
KernelTables runnable_kernels();

}  // namespace target_core
