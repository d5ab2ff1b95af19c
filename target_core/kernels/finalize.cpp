// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/finalize.comp.
#include "target_core/kernels/finalize.h"

#include "target_core/kernels/kernels.h"

namespace target_core::kernels {

void finalize() { for_each_job<finalize_pixel>(pass.path_count); }

}  // namespace target_core::kernels
