// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace porttool {

/// One segment of a pattern against one name; knows `*`, `?`, `[...]` and escapes. Linear where the greedy walk finds
/// its way; else a word of 64 places of the pattern at a time for each character of the name.
bool segment_matches(std::string_view pattern, std::string_view name);

}  // namespace porttool
