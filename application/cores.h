// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render_system/core_registry.h"

namespace application {

/// The cores built into this program, in order of preference: source, target, null.
render_system::CoreRegistry make_registry();

}  // namespace application
