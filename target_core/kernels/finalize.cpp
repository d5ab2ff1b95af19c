// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/finalize.comp.
#include "target_core/kernels/finalize.h"

#include "target_core/kernels/kernels.h"

namespace target_core::kernels {

void finalize() {
    uint job_count = pass.path_count;
    for (uint job = 0; job < job_count; ++job) {
        finalize_pixel(job);
    }
}

}  // namespace target_core::kernels
