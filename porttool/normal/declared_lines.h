// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/normal/word_macros.h"

namespace porttool {

/// What a file says of words that functions use beside its macros: constants and variables with their types and values,
/// each enumerator with its number, types under another name, and the members of GLSL's and HLSL's blocks. A `=` stands
/// before the word in each line:
///
///     __constant__ float gain = 1.5f;          =gain        __constant__ float gain = 1.5f
///     enum Mode { ADD, MUL = 4, SUB };         =SUB         enum SUB = 5
///     typedef float real;                      =real        typedef float real
///     uniform PC { float a; int n; } pc;       =pc          uniform PC { float a ; int n ; }
///     cbuffer PC { float a; int n; };          =n           int n
///
/// In order of the file; takes time in line with it.
std::vector<MacroLine> declared_lines(const ScannedFile& file);

}  // namespace porttool
