// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/compare/meaning.h"

namespace porttool {

/// True if the edits of two functions that each drive a device in the way of its runtime brought and took the same
/// names and numbers, but for those of a runtime and for names that the other side does not have at all, and if what
/// both call now is given the same of these in the same order; where both launch in `<<< >>>`, for how many threads,
/// too:
///
///     + shade < < < n / 64 , 64 > > > ( in , out , n )
///     + q . parallel_for ( nd_range < 1 > ( n / 64 * 64 , 64 ) , [ = ] ( nd_item < 1 > item ) { shade ( item , in ,
///     out , n ) ; } )
bool bring_the_same_names(const PairTexts& texts);

}  // namespace porttool
