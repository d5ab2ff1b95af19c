// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/shade.comp.
#include "target_core/kernels/shade.h"

#include "target_core/kernels/kernels.h"

namespace target_core::kernels {

void shade() {
    uint job_count = extension_job_count();
    for (uint job = 0; job < job_count; ++job) {
        shade_path(job);
    }
}

}  // namespace target_core::kernels
