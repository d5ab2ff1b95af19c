// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/normal/normal_text.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// Two paired constants by value, or two paired structs by their fields.
struct ComparedValues {
    bool same = false;
    bool certain = false;  ///< no name is left whose meaning lies elsewhere: they differ if `same` is false
    std::string says;      ///< what each side has, as written; for a message
};

/// Compares two units of the same kind, constant or struct, by their tokens in normal form.
ComparedValues compare_values(UnitKind kind, const Words& source, const Words& target, const Dialect& dialect);

/// The value of a constant expression in tokens of normal form, in a spelling that is the same for all that write it:
/// integers and reals with + - * / % << >> & | ^ ~, parentheses, casts and constructors of built-in types, and lists in
/// braces. "" if it cannot be told, as where a name stands. Integer arithmetic is that of C with 64 bits; an unsigned
/// operand without a larger suffix has 32.
std::string evaluate_constant(const Words& tokens, const Dialect& dialect);

}  // namespace porttool
