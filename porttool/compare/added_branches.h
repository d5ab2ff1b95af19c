// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "porttool/normal/normal_text.h"
#include "porttool/scan/token.h"

namespace porttool {

/// The macros that an edit asks for by branches of the preprocessor, where it did nothing but add texts for them: as a
/// compiler reads the text that has never heard of the macros, it says what it said. Each branch has an `#else`, and
/// the texts say something in the place of others. None where more was edited, where a branch only says more than its
/// `#else` (a feature), or where one of the macros may be known to a compiler by itself.
///
///     before             sum += at ( i ) ;
///     now                # if IMAGES sum += fetch ( i ) ;   # else sum += at ( i ) ; # endif
std::set<std::string_view> macros_of_added_branches(const Words& before, const Words& now);

/// True for a name that compilers define, or may define, without being told, or with a header of their own
/// (`__CUDA_ARCH__`, `GL_ES`, `NDEBUG`, `FLT_MAX`).
bool is_macro_of_compilers(std::string_view name);

/// A file as a compiler reads it that has never heard of some macros: what asks for one of them is `#if 0`, or `#if 1`
/// where it asks for its absence.
std::string without_macros(const LexedText& file, const std::set<std::string_view>& macros);

}  // namespace porttool
