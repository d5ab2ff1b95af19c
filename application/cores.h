// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "application/options.h"
#include "render_system/core_registry.h"

namespace application {

/// The cores built into this program, in order of preference: source, target, null. Each is created with what the
/// options say to it alone.
render_system::CoreRegistry make_registry(const Options& options);

}  // namespace application
