// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/guide.comp.
#include "target_core/kernels/guide.h"

#include "target_core/kernels/kernels.h"

namespace target_core::kernels {

void guide() { for_each_job<guide_path>(surface_job_count()); }

}  // namespace target_core::kernels
