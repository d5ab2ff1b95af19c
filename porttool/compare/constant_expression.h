// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/language/dialect.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

/// What a type makes of a number. Many: a vector or an array, a list of numbers.
enum class NumberType : uint8_t { None, Int, Unsigned, Real, Many };

/// Of a built-in type; None for any other word.
NumberType number_type(std::string_view word, const Dialect& dialect);

/// The value of a constant expression in tokens of normal form, in a spelling that is the same for all that write it:
/// integers and reals with + - * / % << >> & | ^ ~, parentheses, casts and constructors of built-in types, and lists in
/// braces. "" if it cannot be told, as where a name stands. Integer arithmetic is that of C with 64 bits; an unsigned
/// operand without a larger suffix has 32.
///
///     1u << 5                      32
///     ( int ) 2.5 * 3              6
///     float3 ( 0.5f , 1 , 0 )      {0.5,1,0}
///     1 << BITS                    ""
std::string evaluate_constant(const Words& tokens, const Dialect& dialect);

}  // namespace porttool
