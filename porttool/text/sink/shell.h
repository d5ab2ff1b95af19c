// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace porttool {

/// A text as one word of a POSIX shell (XCU 2.2.2), in single quotes: /bin/sh reads back exactly these bytes. The text
/// must not hold NUL, and may be an option to a program if it begins with a dash.
std::string shell_quoted(std::string_view text);

/// The same, as it is where no shell would make anything of it.
std::string shell_word(std::string_view text);

/// True for what can be copied from a screen and pasted as an argument: not empty, no option, nothing invisible.
bool can_be_pasted(std::string_view text);

}  // namespace porttool
