// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/toml_string.h"

#include <fmt/format.h>

#include "porttool/text/visible.h"

namespace porttool {

/// Beside control characters, which TOML asks for, what would be read otherwise than it is.
static std::string escaped(char32_t code) {
    constexpr char32_t kPlanes = 0x10000;
    const auto value = static_cast<uint32_t>(code);
    return code < kPlanes ? fmt::format("\\u{:04X}", value) : fmt::format("\\U{:08X}", value);
}

std::string toml_string(std::string_view text) {
    std::string quoted;
    for (const char c : text) quoted += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    return "\"" + without_log_commands(without_invisible(quoted, escaped), "\\u0023") + "\"";
}

}  // namespace porttool
