// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The kernel text once more, over 8 lanes, in a namespace of its own; guide, shade and the
// filters are in guide_avx2.cpp, materials_avx2.cpp and filters_avx2.cpp.
#define TARGET_CORE_LANES "target_core/device/lanes_avx2.h"
#define TARGET_CORE_TRACE "target_core/device/wide_trace.h"
#define kernels kernels_avx2
#include "target_core/kernels/connect.cpp"
#include "target_core/kernels/extend.cpp"
#include "target_core/kernels/finalize.cpp"
#include "target_core/kernels/generate.cpp"
#undef kernels
#include "target_core/device/kernel_table.h"

#ifdef TARGET_CORE_8_LANES

namespace target_core {

namespace kernels_avx2_without_lobes {
void shade();  // of shade_avx2.cpp
}

namespace {

#ifdef TARGET_CORE_SHADES_TWICE
void shade() {
    (settings.features & LOBE_FEATURES) != 0u ? kernels_avx2::shade() : kernels_avx2_without_lobes::shade();
}
#else
using kernels_avx2::shade;
#endif

}  // namespace

const KernelTable avx2_kernels = {"8 lanes, AVX2",
                                  8,
                                  kernels_avx2::generate,
                                  kernels_avx2::extend,
                                  shade,
                                  kernels_avx2::connect,
                                  kernels_avx2::finalize,
                                  kernels_avx2::guide,
                                  kernels_avx2::filter,
                                  kernels_avx2::reproject};

}  // namespace target_core

#endif  // else 16 lanes alone, whose extend is that of 8
