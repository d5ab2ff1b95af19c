// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "porttool/normal/normal_text.h"
#include "porttool/scan/token.h"

namespace porttool {

/// The macros for which an edit added other texts by branches of the preprocessor, where it did nothing else: as a
/// compiler reads the text that has never heard of the macros, it says what it said. Each branch has an `#else`. Empty
/// where more was edited, or one of them may be known to a compiler by itself (`__CUDA_ARCH__`, `GL_ES`, `NDEBUG`).
///
///     sum += at ( i ) ;        # if IMAGES sum += fetch ( i ) ; # else sum += at ( i ) ; # endif
std::set<std::string_view> macros_of_added_branches(const Words& before, const Words& now);

/// A file as a compiler reads it that has never heard of some macros: what asks for one of them is `#if 0`, or `#if 1`
/// where it asks for its absence.
std::string without_macros(const LexedText& file, const std::set<std::string_view>& macros);

}  // namespace porttool
