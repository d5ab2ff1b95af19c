// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/language/language.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

/// A text in which choices between two values, and a few built-ins that stand for more than one operation, are written
/// in one manner. What it computes is the same, but for the last bit of `mix` and `dot` and for what is no number:
///
///     k > n                                     n < k                   where it alone decides
///     if ( a <= b ) { A } else { B }            if ( b < a ) { B } else { A }
///     x < y ? y : x,  if ( x < y ) { x = y ; }  max ( x , y ),  x = max ( x , y ) ;
///     clamp ( x , a , b )                       min ( b , max ( a , x ) )
///     step ( e , x )                            ( x < e ? 0 : 1 )
///     a + ( b - a ) * t                         mix ( a , b , t )
///     p . x * q . x + p . y * q . y             dot ( p , q )           of what is declared with two parts
///     abs ( x ),  fabsf ( x )                   fabs ( x )              of what is declared as a real number
///
/// Of a text that is too long, or has brackets that do not close, nothing is.
std::vector<std::string> with_plain_choices(const Words& text, Language language);

}  // namespace porttool
