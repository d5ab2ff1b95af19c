// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"

namespace porttool {

/// A unit's text in normal form without what speaks to people alone: statements that print, log or assert, that read a
/// clock, and what stands between `#ifdef` and `#endif` of a macro that is named after such things.
///
///     # ifdef TIMING t0 = now ( ) ; # endif x = f ( y ) ; printf ( "%f" , x ) ;        x = f ( y ) ;
Words without_asides(const Words& tokens);

}  // namespace porttool
