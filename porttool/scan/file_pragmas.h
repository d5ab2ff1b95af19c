// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// The pragmas that stand outside of functions and that later units depend on: those about floating-point arithmetic
/// and code generation hold up to the next of their kind, `pack` up to its `pop`. At most 64 of them.
std::vector<FilePragma> read_file_pragmas(const LexedText& lexed, const std::vector<Unit>& units);

/// Adds what `#pragma omp threadprivate(a, b)` says of variables.
void read_variable_pragmas(const LexedText& lexed, std::vector<FileVariable>& out);

}  // namespace porttool
