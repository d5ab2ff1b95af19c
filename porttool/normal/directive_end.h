// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"

namespace porttool {

/// Where the preprocessor line ends that begins with words[at], as far as its words tell: the normal form has no lines.
/// 0 where nothing tells, or no such line begins there.
///
///     # endif a = b ;                            behind `endif`
///     # pragma omp parallel for for ( ... )      behind OpenMP's `for`
size_t directive_end(const Words& words, size_t at);

}  // namespace porttool
