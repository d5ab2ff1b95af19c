// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace porttool {

/// Text as the text of an element or as an attribute in double quotes (HTML Living Standard, 13.1.2 and 13.1.4). Not
/// for scripts, styles, comments or addresses.
std::string html_text(std::string_view text);

}  // namespace porttool
