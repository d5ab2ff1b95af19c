// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render_system/status.h"

namespace render_system {

/// The folders in which this program's modules may lie: lib/porttool beside its own folder, as installed and as built,
/// and, for programs of a sanitized build, which lie one folder deeper, one above that.
std::vector<std::filesystem::path> module_folders();

/// The module of that file name; fails with not_found, naming the folder where it should be.
Result<std::filesystem::path> find_module(const std::string& name);

/// Loads a module and answers the address of what it exports under `symbol`. It stays loaded. Fails with not_found and
/// what the system says where it does not load or exports no such thing.
Result<void*> load_module(const std::filesystem::path& file, const char* symbol);

}  // namespace render_system
