// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/sink/json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "porttool/text/visible.h"

namespace porttool {
namespace {

std::string escaped(char32_t code) {
    constexpr char32_t kPlanes = 0x10000, kHigh = 0xD800, kLow = 0xDC00, kPayload = 0x3FF;
    constexpr int kBits = 10;
    if (code == '\n') return "\n";  // between values: within strings it is escaped already
    const auto unit = [](char32_t value) { return fmt::format("\\u{:04x}", static_cast<uint32_t>(value)); };
    if (code < kPlanes) return unit(code);
    return unit(kHigh + ((code - kPlanes) >> kBits)) + unit(kLow + ((code - kPlanes) & kPayload));
}

}  // namespace

std::string json_text(const nlohmann::ordered_json& value, int indent) {
    const std::string text = value.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    return without_log_commands(without_invisible(text, escaped), "\\u0023");
}

}  // namespace porttool
