// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "render_system/status.h"

namespace render_system {

/// The whole content of a regular file of at most `most_bytes`. Fails with not_found or unreadable, at once also for a
/// pipe or a device; the message names the file.
Result<std::string> read_input_file(const std::filesystem::path& path, uint64_t most_bytes);

/// Whether `path` is a file that can be read. Fails as read_input_file does.
Status check_input_file(const std::filesystem::path& path);

}  // namespace render_system
