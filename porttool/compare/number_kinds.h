// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/compare/meaning.h"

namespace porttool {

/// A sentence where statements that both sides gained say the same of other kinds of numbers, which the common
/// vocabulary folds; else "".
///
///     source             port
///     x += k / 2         x += k / 2u           of `int k`: the suffix makes the quotient one of numbers without a sign
///     x = fabs(x)        x = abs(x)            of `float x`, in C: its `abs` is one of whole numbers
///
/// Only where the texts declare what the numbers are joined with.
std::string other_kinds_of_numbers(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages);

}  // namespace porttool
