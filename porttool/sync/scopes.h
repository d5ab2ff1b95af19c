// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "porttool/normal/normal_text.h"

namespace porttool {

/// Names of a unit in normal form that are used where none of its declarations of them reaches: after the block that
/// declares them, or before. What it never declares comes from elsewhere and is not told.
///
///     { float norm = f ( z ) ; }   color += norm ;        norm
std::set<std::string> names_out_of_scope(const std::vector<std::string>& words);

/// Names that an edit leaves without a declaration: out of scope as above and not before, or declared before, used
/// still, and declared no more.
std::set<std::string> lost_names(const std::vector<std::string>& before, const std::vector<std::string>& now);

/// Names that an edit declares twice in one block, as nothing was before.
std::set<std::string> names_doubled(const std::vector<std::string>& before, const std::vector<std::string>& now);

/// Parameters and variables that are declared as pointers, and none of them otherwise as well.
std::set<std::string, std::less<>> declared_pointers(const std::vector<std::string>& words);

/// The words with `;` in place of each of a preprocessor line's.
Words without_directives(const std::vector<std::string>& words);

/// Where names are declared behind a macro and a type, which nothing else tells from two names side by side:
/// `LOCAL_AS float tile [ 64 ] ;`, `for ( MAYBE_VOLATILE int i = 0 ; ...`. First the macro's place, then the name's.
std::vector<std::pair<size_t, size_t>> declared_behind_macro(const Words& words);

}  // namespace porttool
