// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"

namespace porttool {

/// True if all that an edit did was to call functions by names that differ in case, underscores and `std::` alone:
/// which function that is, the texts do not say, but it is most likely meant to do the same.
///
///     before      d = SQRT(x); atomic_max(p, d);
///     now         d = std::sqrt(x); atomicMax(p, d);
bool only_respells_calls(const Words& before, const Words& now);

/// The first call in a text of something other than `name` that is spelled like it, or "".
std::string_view respelled_call(const NormalText& text, std::string_view name);

}  // namespace porttool
