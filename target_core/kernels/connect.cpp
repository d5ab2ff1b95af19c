// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/connect.comp.
#include "target_core/kernels/connect.h"

#include "target_core/kernels/kernels.h"

namespace target_core::kernels {

void connect() { for_each_job<connect_shadow_ray>(shadow_job_count()); }

}  // namespace target_core::kernels
