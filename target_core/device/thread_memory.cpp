// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/device/bindings.h"

namespace target_core {

void reach_thread_memory() { asm volatile("" : : "r"(&bound)); }

}  // namespace target_core
