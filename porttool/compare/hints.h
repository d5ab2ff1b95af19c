// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"

namespace porttool {

/// A text in normal form without what only advises a compiler: pragmas for unrolling and about warnings, `ivdep`,
/// `omp simd`, and of `omp parallel for` the clauses that only schedule. What can change a value or a race stays
/// (`reduction`, `private`, `nowait`, ...), and so does a pragma that is not known, since where it ends is not.
///
///     # pragma unroll 4 for ( ... )                                       for ( ... )
///     # pragma omp parallel for schedule ( static ) private ( i )         # pragma omp parallel for private ( i )
///     # pragma omp simd reduction ( + : sum )                             stays
Words without_hints(const Words& tokens);

}  // namespace porttool
