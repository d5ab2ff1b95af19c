// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/generate.comp.
#include "target_core/kernels/generate.h"

#include "target_core/kernels/kernels.h"

namespace target_core::kernels {

void generate() { for_each_job<generate_path>(pass.path_count); }

}  // namespace target_core::kernels
