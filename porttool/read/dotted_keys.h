// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace porttool {

/// The line of a TOML text where a key has more dots than anyone writes. Each is a table in a table, and what reads
/// them calls itself for each.
std::optional<uint32_t> line_of_deep_key(std::string_view text);

}  // namespace porttool
