// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "porttool/language/words.h"
#include "porttool/text/is_one_of.h"

namespace porttool {

/// What stands before the brackets of attributes that are not in `[[...]]`.
inline bool opens_attributes(std::string_view word) {
    return is_one_of(word, {"__attribute__", "__attribute", "__declspec"});
}

/// True for an attribute that only says how a function is linked or inlined, or what is warned of, by its name or that
/// between underscores. One that makes another function of it is asked for elsewhere (DeclaredWord::Kind::Linked).
inline bool is_idle_attribute(std::string_view name) {
    const bool has_both = name.size() > 4 && name.starts_with("__") && name.ends_with("__");
    if (has_both) name = name.substr(2, name.size() - 4);
    return word_is(name, kIdleAttribute) || is_one_of(name, {"format", "format_arg", "alias", "ifunc"});
}

}  // namespace porttool
