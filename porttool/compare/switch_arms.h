// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "porttool/compare/edits.h"
#include "porttool/language/dialect.h"

namespace porttool {

/// What the other side has where an edit brought in arms of a `switch` alone.
enum class ArmsOfOther : uint8_t {
    None,    ///< no arms of these labels, or the edit did something else
    Others,  ///< arms in the same names that reckon something else: a wrong port
    Any,     ///< arms that do something in words of their own
    Same,    ///< arms that say the same, but for brackets and types
};

/// Of an edit that only brought in whole arms, each left at its end by `break`, `return`, `continue` or `goto`, what
/// the other text has for their labels. Tokens in normal form.
///
///     before    case A : return f ( x ) ;
///     now       case A : return f ( x ) ; case B : return a * b ;
///     other     case A : return f ( x ) ; case B : return a * b ;      the same; `a / b` others; `emit ( MUL )` any
ArmsOfOther arms_of_other(const LoneTexts& texts, const Dialect& dialect);

}  // namespace porttool
