// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "porttool/normal/normal_text.h"

namespace porttool {

/// The lines of a text, each with its line end.
Words lines_with_ends(std::string_view text);

/// A unified diff that `git apply` takes, three lines of context around each change; "" for equal texts. A file that
/// was not there before has an empty text and `is_new`.
std::string unified_diff(const std::string& path, std::string_view before, std::string_view now, bool is_new = false,
                         size_t lines_in_front = 0);

}  // namespace porttool
