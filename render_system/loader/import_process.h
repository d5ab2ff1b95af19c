// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render_system/loader/file_bytes.h"

namespace render_system {

/// A request to `pathtracer-import`, which lies beside the running program (render_system/importer/importer.h).
struct ImportRequest {
    std::string format;                  ///< obj, fbx or draco
    std::vector<std::string> arguments;  ///< after the limits
    std::span<const std::byte> input;    ///< its stdin
    uint64_t file_bytes = 0;             ///< of what it reads: memory and time are limited by this
};

/// What it answered. Throws LoadError with its message, or with what became of it: a crash, too much memory or time.
FileBytes run_importer(const ImportRequest& request);

}  // namespace render_system
