// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What is said of paths that are not opened: the end of a sentence that the path begins.
#pragma once

#include <string>
#include <string_view>

namespace porttool {

/// True for a path with a folder `.git` in it, in any spelling.
bool names_git_folder(std::string_view path);

std::string leads_out(const std::string& root);

/// What a failed call of the system says. `code`: its `errno`.
std::string cannot_be_read(int code);

}  // namespace porttool
