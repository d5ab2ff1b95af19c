// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The kernel text once more, over 16 lanes, in a namespace of its own; guide, shade and the
// filters are in guide_avx512.cpp, materials_avx512.cpp and filters_avx512.cpp.
#define TARGET_CORE_LANES "target_core/device/lanes_avx512.h"
#define TARGET_CORE_TRACE "target_core/device/wide_trace.h"
#define kernels kernels_avx512
#include "target_core/kernels/connect.cpp"
#include "target_core/kernels/extend.cpp"
#include "target_core/kernels/finalize.cpp"
#include "target_core/kernels/generate.cpp"
#undef kernels
#include "target_core/device/kernel_table.h"

namespace target_core {

namespace kernels_avx2 {
void extend();  // of kernels_avx2.cpp
}

namespace kernels_avx512_without_lobes {
void shade();  // of shade_avx512.cpp
}

namespace {

// The 16-lane code traces camera rays only, though its text would do for all. Rays that go everywhere are faster by 8,
// and Embree's code for that is faster again among code without 512 bits.
void extend() { pass.segment == 1 ? kernels_avx512::extend() : kernels_avx2::extend(); }

#ifdef TARGET_CORE_SHADES_TWICE
void shade() {
    (settings.features & LOBE_FEATURES) != 0u ? kernels_avx512::shade() : kernels_avx512_without_lobes::shade();
}
#else
using kernels_avx512::shade;
#endif

}  // namespace

const KernelTable avx512_kernels = {"16 lanes, AVX-512",
                                    16,
                                    kernels_avx512::generate,
                                    extend,
                                    shade,
                                    kernels_avx512::connect,
                                    kernels_avx512::finalize,
                                    kernels_avx512::guide,
                                    kernels_avx512::filter,
                                    kernels_avx512::reproject};

}  // namespace target_core
