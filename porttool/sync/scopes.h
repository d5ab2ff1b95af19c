// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

namespace porttool {

/// Names of a unit in normal form that are used where none of its declarations of them reaches: after the block that
/// declares them, or before. What it never declares comes from elsewhere and is not told.
///
///     { float norm = f ( z ) ; }   color += norm ;        norm
std::set<std::string> names_out_of_scope(const std::vector<std::string>& words);

/// Names that an edit leaves without a declaration: out of scope as above and not before, or declared before, used
/// still, and declared no more.
std::set<std::string> lost_names(const std::vector<std::string>& before, const std::vector<std::string>& now);

/// Names that are declared behind a macro and a type, which nothing else tells from two names side by side:
/// `LOCAL_AS float tile [ 64 ] ;`, `for ( MAYBE_VOLATILE int i = 0 ; ...`.
std::set<std::string> declared_behind_macro(const std::vector<std::string>& words);

}  // namespace porttool
