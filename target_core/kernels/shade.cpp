// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/shade.comp.
#include "target_core/kernels/shade.h"

#include "target_core/kernels/kernels.h"

namespace target_core::kernels {

void shade() { for_each_job<shade_path>(surface_job_count()); }

}  // namespace target_core::kernels
