// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Shading over 16 lanes once more, for scenes without the lobes that most lack. A branch never taken would still cost:
// what lies behind it takes registers from the rest.
#define TARGET_CORE_LANES "target_core/device/lanes_avx512.h"
#define TARGET_CORE_TRACE "target_core/device/wide_trace.h"
#define TARGET_CORE_WITHOUT LOBE_FEATURES
#define kernels kernels_avx512_without_lobes
#include "target_core/kernels/shade.cpp"
