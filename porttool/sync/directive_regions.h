// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/compare/alignment.h"

namespace porttool {

/// The clauses of a text between `#if` and `#endif` where the target has such conditions, and others: whether what
/// stands there is the same is not told. The target may ask alike under names of its own, the same one each time, where
/// most of what stands there has its counterpart there.
///
///     # if defined ( RUN_SEQ )        # if defined ( RUN_OPENMP )        # ifdef DEBUG
///     forall ( n , body ) ;           forall ( n , body ) ;              print ( n ) ;
///     # endif                         # endif                            # endif
///                                     not another one                    another one
std::vector<bool> under_other_directives(const AlignedText& text, const AlignedText& target, const Alignment& across);

}  // namespace porttool
