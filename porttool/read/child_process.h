// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace porttool {

/// What a shell would give: the code that a process ended with, or 128 and the number of the signal that ended it.
/// `status`: of waitpid().
int exit_code_of(int status);

/// Hands on what can be read of a pipe without waiting, a MiB at most; false at its end.
bool take_available(int pipe, const std::function<void(std::string_view)>& take);

}  // namespace porttool
