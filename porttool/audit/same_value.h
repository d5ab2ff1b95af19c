// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace porttool {

/// True if two statements, as essence_of() has them, give the same real numbers: both are evaluated for names drawn at
/// random, zero, very small and very large ones among them, as Schwartz (1980) and Zippel (1979) test polynomials.
///
///     1f / ( 2f * sqrt ( a ) )       ( a < b ) ? a : b
///     0.5f / sqrt ( a )              min ( a , b )
///
/// Rounding and casts do not count. What is no arithmetic (a comparison, an unknown call, a remainder, `/` between what
/// may be integers) has a value that depends on its operands alone. False for what cannot be read.
/// `real`: they are known to be of real numbers, as has_real_number() tells of what was written.
bool give_the_same_value(const std::vector<std::string>& a, const std::vector<std::string>& b, bool real = false);

/// True for words of which one is a number with a point, an exponent or an `f`.
bool has_real_number(const std::vector<std::string>& words);

/// True for two branches of which one is taken where the other is not: `if (a <= i || i < b)`, `if (i < a && i >= b)`.
bool ask_the_opposite(const std::vector<std::string>& a, const std::vector<std::string>& b);

}  // namespace porttool
