// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/sink/sarif.h"

#include <fmt/format.h>

#include "porttool/text/visible.h"

namespace porttool {

std::string sarif_message(std::string_view text) {
    std::string out = visible(text);
    if (out.find("](") == std::string::npos) return out;
    std::string escaped;
    for (const char c : out) escaped += c == '[' || c == ']' ? std::string("\\") + c : std::string(1, c);
    return escaped;
}

std::string uri_path(std::string_view path) {
    std::string out;
    for (const char c : path) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           std::string_view("/-._~").find(c) != std::string_view::npos;
        out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return out;
}

}  // namespace porttool
