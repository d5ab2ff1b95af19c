// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace porttool {

/// One field of a line of CSV (RFC 4180), quoted where it must be, and where a spreadsheet that parts fields at
/// semicolons would part it. A field is one line of visible text. What a spreadsheet would take for a formula (`=`,
/// `+`,
/// `-`, `@`, also full-width and after blanks) gets an apostrophe before it.
std::string csv_field(std::string_view text);

}  // namespace porttool
