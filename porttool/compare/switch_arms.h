// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"

namespace porttool {

/// True if all that an edit did was to bring whole arms into a `switch`, each left at its end by `break`, `return`,
/// `continue` or `goto`, and the other text has an arm for each of their labels, whatever it does there. Tokens in
/// normal form.
///
///     before    case A : f ( ) ; break ;
///     now       case A : f ( ) ; break ; case B : g ( x ) ; break ;
///     other     case A : return a ( x ) ; case B : return b ( x ) ;
bool only_adds_arms_of_other(const Words& before, const Words& now, const Words& other);

}  // namespace porttool
