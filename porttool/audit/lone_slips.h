// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Slips that one text alone tells, whatever the other side says.
#pragma once

#include <string>
#include <vector>

#include "porttool/audit/lineage.h"

namespace porttool {

/// A statement that cannot be meant as it stands.
struct LoneSlip {
    size_t statement = 0;  ///< among those of the unit
    std::string what;      ///< goes on from "the source ...": "takes `a . x` from itself"
    std::string remedy;
    bool is_sure = false;  ///< nothing but a slip, even where another text says the same: what comes of it nobody knows

    bool operator==(const LoneSlip&) const = default;
};

/// The slips of a unit's statements, in their order; at most one a statement. Nothing is told of what some people write
/// on purpose: `x != x` for a number that is none, `x - x`, numbers alone, calls that give something else each time.
///
///     if ( a . x > 0 && a . y > 0 && a . x > 0 )      asks one thing twice
///     c = p . x - p . x ;  m = max ( b , b ) ;        an operand twice
///     for ( j = 0 ; i < n ; j ++ )                    another loop's variable
///     float w [ 3 ] ;  w [ 3 ] = 1 ;                  behind the end
///     sum = m [ c - 1 ] + m [ + 1 ] ;                 the first operand is not there
///     t = a ? b : b ;                                 a choice of one
///     float2 v ;  ...  p = p + v ;                    a component is never set
///
/// And what does not go along with its neighbours (sibling_slips.h).
std::vector<LoneSlip> lone_slips(const std::vector<WrittenStatement>& statements);

}  // namespace porttool
