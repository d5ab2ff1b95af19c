// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "render_system/core_api.h"

namespace render_system {

/// The smallest core: holds every caller to the contract of CoreAPI and renders black. An example to start from, and
/// the reference for the contract tests.
std::unique_ptr<CoreAPI> create_null_core();

}  // namespace render_system
