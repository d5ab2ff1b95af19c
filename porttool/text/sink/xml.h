// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace porttool {

/// Text as the text of an element or as an attribute in double quotes (XML 1.0, 2.4 and 2.3). What no document may hold
/// (2.2), as most control characters, is visible as in a terminal.
std::string xml_text(std::string_view text);

}  // namespace porttool
