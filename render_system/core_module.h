// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "render_system/core_api.h"

namespace render_system {

/// What a core is told before Init, beside CoreOptions; each takes of it what concerns it.
struct CoreCreation {
    uint64_t memory_limit = 0;      ///< bytes of device memory, 0: the device-local heap
    std::string kernels_directory;  ///< empty: the kernels built into the core
};

/// What the module of a core tells of itself. It stays as long as the module.
struct CoreModule {
    const char* interface;  ///< core_interface() as it was compiled into the module; the first member in all versions
    const char* id;         ///< the file is called pathtracer-core-ID.so

    /// A new core, not yet through Init.
    std::unique_ptr<CoreAPI> (*create)(const CoreCreation& creation);

    /// Whether the device that the core would take is no device but a processor's own program, as Mesa's lavapipe: then
    /// `--core auto` asks the target core first. Null where that is not known.
    bool (*runs_in_software)();
};

}  // namespace render_system

/// The one function that a module exports.
extern "C" [[gnu::visibility("default")]] const render_system::CoreModule* pathtracer_core();
