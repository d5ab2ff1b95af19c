// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render_system/status.h"

namespace render_system {

/// The environment variable that may name a folder of modules, which goes before the program's own.
constexpr const char* kModulesVariable = "PATHTRACER_MODULES";

/// The folders in which modules may lie, in the order in which they are looked into: what PATHTRACER_MODULES names,
/// then lib/porttool beside this program's own folder, as installed and as built, and, for programs of a sanitized
/// build, which lie one folder deeper, one above that. Never the current folder.
std::vector<std::filesystem::path> module_folders();

/// Fails with invalid_argument where PATHTRACER_MODULES names no folder, none by its whole path, or one that anybody
/// may write into: what lies in it would be run.
Status check_module_folders();

/// The module of that file name; fails with not_found, naming the folder where it should be.
Result<std::filesystem::path> find_module(const std::string& name);

/// `copy` loads what the file holds now, from memory: it may be overwritten afterwards, and loaded again.
enum class ModuleSource { file, copy };

/// Loads a module and answers the address of what it exports under `symbol`. It stays loaded. Fails with unreadable
/// and what is wrong with it where it does not load or exports no such thing.
Result<void*> load_module(const std::filesystem::path& file, const char* symbol,
                          ModuleSource source = ModuleSource::file);

}  // namespace render_system
