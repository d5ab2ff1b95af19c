// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render_system/path_watch.h"

namespace target_core {

/// The texts that the kernels were compiled from. Made by the build.
std::vector<render_system::KernelText> kernel_texts();

}  // namespace target_core
