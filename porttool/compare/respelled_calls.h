// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "porttool/normal/normal_text.h"

namespace porttool {

/// A function's name before an edit and after it.
struct RespelledCall {
    std::string_view before, now;
};

/// The calls of an edit that only calls functions by names which differ in case, underscores and `std::`; none if it
/// did anything else. Which functions these are, the texts do not say.
///
///     before      d = SQRT(x); atomic_max(p, d);
///     now         d = std::sqrt(x); atomicMax(p, d);
std::optional<std::vector<RespelledCall>> only_respelled_calls(const Words& before, const Words& now);

/// The first call in a text of something other than `name` that is spelled like it, or "".
std::string_view respelled_call(const NormalText& text, std::string_view name);

/// True if an edit only wrote names with the scope that they stood without, or the other way round, or where a runtime
/// keeps them now, and each of these names stands in one way now.
///
///     nd_item < 3 > & item        sycl :: nd_item < 3 > & item        only the scope
///     ext :: oneapi :: plus < > ( )        sycl :: plus < > ( )       the same function of a runtime
///     std :: max ( a , b )        own :: max ( a , b )                another function
bool only_qualifies_names(const Words& before, const Words& now);

/// True if an edit only picks members of what is a pointer now, or no longer is one (`a.x`, `a->x`): no text has both
/// for one thing. Not of functions, which a smart pointer has of its own (`p.reset()`).
bool only_respells_members(const Words& before, const Words& now);

}  // namespace porttool
