// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

/// A text in which what is computed in one step is computed in several, so that only the rounding of the last bit is
/// another:
///
///     fma ( a , b , c )        ( a * b + c )
///     1 / sqrt ( x )           rsqrt ( x )
///     pow ( x , 2 )            x * x            of a name
///
/// Not `mad`, which may round in either way.
std::vector<std::string> with_other_rounding(const Words& text, const Dialect& dialect);

}  // namespace porttool
