// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "porttool/read/beneath.h"

namespace porttool {

/// Replaces a file of the user's as a whole: a temporary beside it takes its name when it is written. A link stays a
/// link. What is no regular file (a device, a pipe, the open file behind /dev/stdout) is appended to. Returns why it
/// could not, or "".
std::string replace_file(const std::string& path, const std::string& bytes);

/// The same beneath a root, with the file's folder where that is missing.
std::string replace_file(const TreePath& path, const std::string& bytes);

/// Whose temporary a name is: `report.html` for `report.html.tmp4711.1`; "" for any other name. `process` is the one
/// that made it.
std::string_view temporary_of(std::string_view name, int& process);

}  // namespace porttool
