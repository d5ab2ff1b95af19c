// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/sink/shell.h"

#include <algorithm>

#include "porttool/text/visible.h"

namespace porttool {

std::string shell_quoted(std::string_view text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::string shell_word(std::string_view text) {
    const auto is_plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("/-._:@%+=,").find(c) != std::string_view::npos;
    };
    const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), is_plain);
    return plain ? std::string(text) : shell_quoted(text);
}

bool can_be_pasted(std::string_view text) { return !text.empty() && text[0] != '-' && visible(text) == text; }

}  // namespace porttool
