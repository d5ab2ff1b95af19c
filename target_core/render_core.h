// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "render_system/core_api.h"

namespace target_core {

/// The CPU port: the source core's kernels in C++, Embree for the rays, TBB for the tiles. The core opens Embree in
/// Init, and is a render_system::EmbreeProbe too.
std::unique_ptr<render_system::CoreAPI> create_core();

}  // namespace target_core
