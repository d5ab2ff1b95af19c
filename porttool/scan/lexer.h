// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "porttool/scan/token.h"

namespace porttool {

/// Splits a file of any C-family dialect into tokens. Never fails and takes linear time: what does not close (a string,
/// a comment) ends at the end of its line or of the file; a byte that starts nothing becomes a token of its own.
/// Comments are left out but for the lines they cover; preprocessor lines are kept, flagged kInDirective.
LexedText lex(std::string_view file);

}  // namespace porttool
