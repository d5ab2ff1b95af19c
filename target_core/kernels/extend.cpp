// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/extend.comp.
#include "target_core/kernels/extend.h"

#include "target_core/kernels/kernels.h"

namespace target_core::kernels {

void extend() { for_each_job<extend_path>(extension_job_count()); }

}  // namespace target_core::kernels
