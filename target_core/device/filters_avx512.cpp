// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What kernels_avx512.cpp leaves out: the kernels of filters. Apart, since their long loops without a branch want other
// options of the compiler.
#define TARGET_CORE_LANES "target_core/device/lanes_avx512.h"
#define TARGET_CORE_TRACE "target_core/device/wide_trace.h"
#define kernels kernels_avx512
#include "target_core/kernels/filter.cpp"
#include "target_core/kernels/reproject.cpp"
