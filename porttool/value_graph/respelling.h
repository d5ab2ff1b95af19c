// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/value_graph/same_values.h"

namespace porttool {

/// True if two texts of one function differ only in how statements are spelled: they have as many, in the same blocks,
/// and each is the same word for word or sure to do the same, whatever its locals and all else hold (ValueTable).
///
///     if ( ( a > b ) )    count = count + 1                    if ( b < a )    ++ count
///     at = ( w * x ) + y                                       at = x * w + y
///     if ( p != NULL )                                         if ( p )
///
/// Nothing is carried from statement to statement, so that none may move, come or go, and a value that gets a name is
/// another text. What is no plain number may have operators of its own: `a += b` is `a = a + b` and `a * b` is `b * a`
/// for what the text declares as numbers alone, which no other thread updates as one step either.
bool are_respelled(const ReadFunction& one, const ReadFunction& other);

}  // namespace porttool
