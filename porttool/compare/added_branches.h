// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "porttool/normal/normal_text.h"
#include "porttool/scan/token.h"

namespace porttool {

/// Other texts that an edit added by branches of the preprocessor.
struct AddedBranches {
    std::set<std::string_view> macros;  ///< that are asked for; none: this is no such edit
    bool reckons_otherwise = false;     ///< by signs or fractions that the text in the `#else` does not have
};

/// What an edit added for some macros by branches, where it did nothing else: as a compiler reads the text that has
/// never heard of the macros, it says what it said. Each branch has an `#else`, and the texts say something in the
/// place of others. Nothing where more was edited, where a branch only says more than its `#else` (a feature), or where
/// one of the macros may be known to a compiler by itself (`__CUDA_ARCH__`, `GL_ES`, `NDEBUG`).
///
///     before             sum += at ( i ) ;
///     now                # if IMAGES sum += fetch ( i ) ;   # else sum += at ( i ) ; # endif
///     or now             # if FOG sum -= fog ( i ) * 0.5 ;  # else sum += at ( i ) ; # endif      reckons otherwise
AddedBranches added_branches(const Words& before, const Words& now);

/// A file as a compiler reads it that has never heard of some macros: what asks for one of them is `#if 0`, or `#if 1`
/// where it asks for its absence.
std::string without_macros(const LexedText& file, const std::set<std::string_view>& macros);

}  // namespace porttool
