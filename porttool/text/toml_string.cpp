// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/toml_string.h"

#include <fmt/format.h>

namespace porttool {

std::string toml_string(std::string_view text) {
    constexpr unsigned char kFirstPrintable = 0x20, kDelete = 0x7F;
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            out += std::string("\\") + c;
        else if (byte < kFirstPrintable || byte == kDelete)
            out += fmt::format("\\u{:04X}", byte);
        else
            out += c;
    }
    return out + "\"";
}

}  // namespace porttool
