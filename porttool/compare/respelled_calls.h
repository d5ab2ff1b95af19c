// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/normal/normal_text.h"

namespace porttool {

/// A function's name before an edit and after it.
struct RespelledCall {
    std::string_view before, now;
    bool of_macro = false;  ///< one of them is a macro, which may do anything
};

/// The calls of an edit that only calls functions by names which differ in case, underscores and `std::`; none if it
/// did anything else. Which functions these are, the texts do not say. A name that lost or took `std::` alone is both.
///
///     before      d = SQRT(x); atomic_max(p, d);
///     now         d = std::sqrt(x); atomicMax(p, d);
std::optional<std::vector<RespelledCall>> only_respelled_calls(const Words& before, const Words& now);

/// The first call in a text of something other than `name` that is spelled like it, or "".
std::string_view respelled_call(const NormalText& text, std::string_view name);

/// A name, and the scope that it stands with now and stood without, or the other way round: `coarse::`; "" where a
/// runtime keeps it elsewhere now.
struct RescopedName {
    std::string_view name;
    std::string scope;
};

/// The names of an edit that only wrote them with the scope that they stood without, or the other way round, or where
/// a runtime keeps them now, and each of these names stands in one way now; none if it did anything else. Whether they
/// are names of the same things, the texts do not say.
///
///     nd_item < 3 > & item        sycl :: nd_item < 3 > & item        `nd_item`, `sycl::`
///     ext :: oneapi :: plus < > ( )        sycl :: plus < > ( )       `plus`, ""
///     std :: max ( a , b )        own :: max ( a , b )                another function
std::optional<std::vector<RescopedName>> only_qualified_names(const Words& before, const Words& now);

/// True for `std::`, `sycl::ext::oneapi::`, `metal::`: where a library has its functions. Not for a namespace of the
/// library that holds others of the same names, less exact ones mostly (`native::`, `metal::fast::`).
bool is_scope_of_library(std::string_view scope);

/// True if an edit only picks members of what is a pointer now, or no longer is one (`a.x`, `a->x`): no text has both
/// for one thing. Not of functions, which a smart pointer has of its own (`p.reset()`).
bool only_respells_members(const Words& before, const Words& now);

}  // namespace porttool
