// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"

namespace porttool {

/// True if an edit only calls what a runtime named otherwise in an earlier version, or back:
///
///     before      sum += group.shuffle_down(sum, 1);                  x = __shfl_down(x, 1);
///     now         sum += sycl::shift_group_left(group, sum, 1);       x = __shfl_down_sync(mask, x, 1);
///
/// What differs in a mark of its version alone (`hipblasDotEx_v2`, `hipblasDotEx_64`) is the same, too.
bool only_follows_runtime(const Words& before, const Words& now);

}  // namespace porttool
