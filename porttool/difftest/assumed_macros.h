// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "porttool/difftest/closure.h"

namespace porttool {

/// The macros, and their values, that must be defined so that a definition is there at all, and that no text its file
/// sees defines: `USE_FOG`, 1 for a function between `#ifdef USE_FOG` and `#endif`. What a compiler defines by itself
/// (`__GNUC__`, `_WIN32`) is never among them.
std::map<std::string, std::string> assumed_macros(const Definition& one, const Definitions& definitions);

/// Those without which a function misses what it calls `name`, though it would have been brought along.
std::map<std::string, std::string> assumed_for(std::string_view name, const Closure& closure,
                                               const Definitions& definitions);

}  // namespace porttool
