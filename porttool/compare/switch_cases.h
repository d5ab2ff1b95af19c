// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"

namespace porttool {

/// The arms of each `switch` by themselves and in the order of their labels, since that order and which labels share an
/// arm say nothing. Only arms that are left at their end for sure, by `break`, `return`, `continue` or `goto`, are told
/// apart; what falls through stays with what it falls into. More than eight levels of `switch` within each other stay
/// as written from there on. Tokens in normal form.
///
///     switch ( k ) { case B : case A : return f ( k ) ; case C : g ( ) ; case D : h ( ) ; break ; }
///     switch ( k ) { case A : return f ( k ) ; break ; case B : return f ( k ) ; break ;
///                    case C : g ( ) ; case D : h ( ) ; break ; }
Words with_sorted_cases(const Words& tokens);

/// True if all that an edit did was to let labels join arms of a `switch` (`case B :` beside `case A :`), and the other
/// text has each of them beside one that it stands beside here.
///
///     before    case A : return true ;
///     now       case A : case B : return true ;
///     other     case A : case B : case C : return f ( x ) ;
bool only_adds_labels_of_other(const Words& before, const Words& now, const Words& other);

/// True if all that an edit did was to let labels join arms, and for one of them the other text has an arm that does
/// something else than the one that it has for those beside it here.
///
///     before    case A : r = a ; break ;
///     now       case A : case B : r = a ; break ;
///     other     case A : r = a ; break ; case B : r = b ; break ;
bool adds_labels_to_other_arms(const Words& before, const Words& now, const Words& other);

}  // namespace porttool
