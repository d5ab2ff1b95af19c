// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render_system/core_module.h"
#include "render_system/modules.h"

namespace render_system {

/// The ids of the cores whose modules lie in a module folder, sorted: what stands between pathtracer-core- and .so in
/// the names of files. Lower-case letters, digits, - and _, and neither auto nor null; other
/// files are passed over. None of them is opened.
std::vector<std::string> core_module_ids();

/// What the file of that core's module is called.
std::string core_module_name(const std::string& id);

/// The file of that core's module; of two of one name the one in the first folder counts. Fails with no_core.
Result<std::filesystem::path> find_core_module(const std::string& id);

/// Loads the module of a core. Fails with no_core where there is none or it is refused: it does not load, exports no
/// pathtracer_core, was compiled for another interface, or calls its core by another id than its file does.
Result<const CoreModule*> load_core_module(const std::string& id, ModuleSource source = ModuleSource::file);

}  // namespace render_system
