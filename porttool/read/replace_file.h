// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/read/disk.h"

namespace porttool {

/// Replaces a file of the user's as a whole: a temporary beside it takes its name when it is written. A link stays a
/// link. What is no regular file (a device, a pipe, the open file behind /dev/stdout) is appended to. Returns why it
/// could not, or "".
std::string replace_file(const std::string& path, const std::string& bytes);

/// The same beneath a root, with the file's folder where that is missing.
std::string replace_file(const TreePath& path, const std::string& bytes);

/// Replaces several files: every temporary is written before the first takes its file's name, and no signal that can be
/// held ends the process in between. Where one fails, all are as they were. Returns which one and why, or "".
std::string replace_files(const std::vector<FileToWrite>& files);

/// The name of what a killed process wrote beside a file and did not give its name; "" for none.
std::string temporary_left(const TreePath& place, int process);

/// Gives a file such a temporary. Returns why it could not, or "".
std::string take_temporary(const TreePath& place, const std::string& temporary);

/// Removes what killed processes left beside these files.
void sweep_beside(const std::vector<TreePath>& files);

/// Removes temporaries of `replace_file` that killed processes left in an open folder: those of files for which
/// `is_swept` holds, and whose process is no more, or, where `all`, of any process.
void sweep_temporaries(int folder, const std::function<bool(std::string_view file)>& is_swept, bool all);

}  // namespace porttool
