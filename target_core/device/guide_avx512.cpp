// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What filters go by over 16 lanes: apart from shading, so that both compile at once.
#define TARGET_CORE_LANES "target_core/device/lanes_avx512.h"
#define TARGET_CORE_TRACE "target_core/device/wide_trace.h"
#define kernels kernels_avx512
#include "target_core/kernels/guide.cpp"
