// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/reproject.comp.
#include "target_core/kernels/reproject.h"

#include "target_core/kernels/kernels.h"

namespace target_core::kernels {

void reproject() {
    if (pass.filter_stage == REPROJECT_LIGHT) {
        for_each_job<reproject_light>(pass.path_count);
    } else {
        for_each_job<reproject_picture>(pass.path_count);
    }
}

}  // namespace target_core::kernels
