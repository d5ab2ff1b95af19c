// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/scan/unit.h"

namespace porttool {

/// Adds what a comment that begins on `line` says: `porttool: ignore(RULE) reason`, also several times. A rule or a
/// reason that goes on without end is cut: in a comment of nothing else each would hold all that follow.
void read_suppressions(std::string_view comment, uint32_t line, std::vector<Suppression>& out);

/// Gives each comment `porttool: ignore(RULE)` of a scanned file to its units. Beside code it belongs to the units that
/// have a token on its line. On a line of its own it belongs to the unit that starts on the next line of code with
/// nothing but comments between, else to the innermost unit around it; in a file without units to the file.
void attach_suppressions(ScannedFile& file);

}  // namespace porttool
