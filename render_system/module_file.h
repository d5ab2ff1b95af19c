// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "render_system/status.h"

namespace render_system {

/// Whether the system's loader can be given that file: a regular one (links are followed), a shared object for this
/// kind of machine, and whole. The loader itself dies of a file that is cut short. Fails with unreadable, naming the
/// file and what it is.
Status check_module_file(const std::filesystem::path& file);

}  // namespace render_system
