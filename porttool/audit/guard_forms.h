// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Guards of values in the forms that they have: a branch, a call, a part of a condition.
#pragma once

#include <cstddef>

#include "porttool/audit/common_texts.h"

namespace porttool {

/// True for one of the two statements `if ( v . x < 0 )` and `v . x = 0` where the other side has `v = max ( v , 0 )`,
/// and the other way round; whatever the bound. Which way it goes counts.
bool is_clamped_otherwise(const ReadSide& here, size_t index, const ReadSide& there);

/// True for `if ( a && b )` where the other side asks `if ( b )`, and this one does not: `a` may be asked around it, or
/// by the preprocessor.
bool is_asked_in_part(const ReadSide& here, size_t index, const ReadSide& there);

/// True for `if ( i >= n )` before a `return`, where the other side leaves, too, by what it asks of `i`, and asks what
/// this side does not: `if ( i == kNone ) continue`.
bool is_left_otherwise(const ReadSide& here, size_t index, const ReadSide& there);

}  // namespace porttool
