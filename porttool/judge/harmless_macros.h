// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "porttool/judge/new_words.h"
#include "porttool/language/dialect.h"

namespace porttool {

/// What becomes of a word that means nothing to a comparison.
enum class LeftOutAs : uint8_t {
    Word,    ///< the normal form has another word, or none, in its place: `register`, `int32_t`
    Unused,  ///< `UNUSED(x);`
    Check,   ///< `CUDA_CHECK(...)`: what stands in the parentheses is all that counts
    Launch,  ///< `hipLaunchKernelGGL(...)`
    Aside,   ///< a call that prints or asserts
    Local,   ///< a variable of the unit's own, whose name is free
};

/// All definitions that a side has of a macro now.
using MacrosNamed = std::function<const std::vector<NewWord>&(std::string_view)>;

/// True if what is said of a word, `#define FORCE_INLINE inline`, `#define CUDA_CHECK(x) report((x), __LINE__)`,
/// `typedef unsigned int uint32_t`, leaves each text that has the word what the comparison takes it for, as its form
/// alone shows, and that of the macros it names. `in_body`: the word stands within a function, where a `static` counts.
/// Of a check with several parameters that holds where all arguments but the first do nothing by themselves.
bool is_harmless(const NewWord& said, LeftOutAs as, bool in_body, const Dialect& dialect, const MacrosNamed& macros);

/// The same of a macro that another one, which the text has, names in its definition.
bool is_harmless_within(const NewWord& macro, LeftOutAs as, bool in_body, const Dialect& dialect,
                        const MacrosNamed& macros);

}  // namespace porttool
