// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "render_system/core_api.h"

namespace source_core {

/// What this core alone can be told.
struct SourceOptions {
    uint64_t memory_limit = 0;      ///< bytes of device memory, 0: the device-local heap
    std::string kernels_directory;  ///< empty: the kernels built into the program
    bool validate = false;          ///< run under the validation layers; messages fail the call
};

/// Whether the device that the core would take is no GPU but a processor's own program, as Mesa's lavapipe. False where
/// there is none at all: Init says why.
bool has_software_device();

/// The GPU path tracer: a wavefront of Vulkan compute kernels. The core opens its device in Init, which also fails with
/// not_found where the folder of kernels or a file in it is missing.
std::unique_ptr<render_system::CoreAPI> create_core(const SourceOptions& options = {});

}  // namespace source_core
