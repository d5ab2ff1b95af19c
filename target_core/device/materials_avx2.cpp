// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What kernels_avx2.cpp leaves out: the kernels that read materials, with all lobes. Apart, so that both compile at
// once, and an edit of how light scatters costs no more than these.
#define TARGET_CORE_LANES "target_core/device/lanes_avx2.h"
#define TARGET_CORE_TRACE "target_core/device/wide_trace.h"
#define kernels kernels_avx2
#include "target_core/kernels/guide.cpp"
#include "target_core/kernels/shade.cpp"
