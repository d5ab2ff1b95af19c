// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What kernels_avx2.cpp leaves out: shading over 8 lanes, with all lobes. Apart, so that all compile at once, and an
// edit of how light scatters costs no more than this and guide_avx2.cpp.
#define TARGET_CORE_LANES "target_core/device/lanes_avx2.h"
#define TARGET_CORE_TRACE "target_core/device/wide_trace.h"
#define kernels kernels_avx2
#include "target_core/kernels/shade.cpp"
