// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "render_system/core_api.h"

namespace source_core {

/// The GPU path tracer: a wavefront of Vulkan compute kernels. The core opens its device in Init.
std::unique_ptr<render_system::CoreAPI> create_core();

}  // namespace source_core
