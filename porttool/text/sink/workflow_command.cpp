// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/sink/workflow_command.h"

#include "porttool/text/visible.h"

namespace porttool {

std::string workflow_data(std::string_view text) {
    std::string out;
    for (const char c : visible(text)) out += c == '%' ? std::string("%25") : std::string(1, c);
    return out;
}

std::string workflow_property(std::string_view text) {
    const size_t end = text.find_first_of("\r\n");
    std::string out;
    for (const char c : workflow_data(text.substr(0, end))) {
        if (c == ':')
            out += "%3A";
        else if (c == ',')
            out += "%2C";
        else
            out += c;
    }
    if (end == std::string_view::npos) return out;
    return out + (text[end] == '\n' ? "%0A" : "%0D") + workflow_property(text.substr(end + 1));
}

}  // namespace porttool
