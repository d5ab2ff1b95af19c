// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"

namespace porttool {

/// True if an edit of a function only added or took away parameters and locals that nothing uses, each declared by
/// itself. What a local begins with may have been called for its own sake: less sure than lone_edit().
///
///     void @ ( float * x , int rows ) { const int row = group ( ) ; x [ 0 ] = 1 ; }
///     void @ ( float * x ) { x [ 0 ] = 1 ; }
bool only_changes_unused_names(const Words& before, const Words& now);

}  // namespace porttool
