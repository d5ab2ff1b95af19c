// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "porttool/language/language.h"

namespace porttool {

/// The one spelling of a word that its language, or the common headers, spell in several ways: `uint32_t` is `uint`,
/// `NULL` is `nullptr`, OpenCL's `global` is `__global`. Stricter than a dialect, whose words take each other's place
/// across languages: two words of one spelling mean the same within one text. Others come back as they are.
std::string_view one_spelling(std::string_view word, Language language);

/// True for a macro that says by its name how a function is to be inlined: `FORCE_INLINE`, `OUR_NOINLINE`.
bool names_inlining(std::string_view word);

/// True for a type that one_spelling() knows, also as `std::uint32_t`.
bool has_other_spellings(std::string_view type);

/// `native`, `precise`: libraries have functions of the names there that they have outside, less exact or more.
bool names_precision(std::string_view scope);

}  // namespace porttool
