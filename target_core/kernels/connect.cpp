// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/connect.comp.
#include "target_core/kernels/connect.h"

#include "target_core/kernels/kernels.h"

namespace target_core::kernels {

void connect() {
    uint job_count = shadow_job_count();
    for (uint job = 0; job < job_count; ++job) {
        connect_shadow_ray(job);
    }
}

}  // namespace target_core::kernels
