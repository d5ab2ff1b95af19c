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

/// True if each attribute of a list is idle: `(weak, gnu::format(printf, 1, 2))`. `word(i)` is that at a place,
/// `is_name(i)` whether it is one, `past(i)` the place behind it, or behind the group that it opens.
template <class Place, class WordAt, class IsName, class Past>
bool are_idle_attributes(Place first, Place end, const WordAt& word, const IsName& is_name, const Past& past) {
    if (first < end && is_one_of(word(first), {"(", "["}))
        return are_idle_attributes<Place>(first + 1, past(first) - 1, word, is_name, past);
    for (Place i = first; i < end; i = past(i)) {
        const bool is_scope = i + 1 < end && word(i + 1) == "::";
        if (is_scope || is_one_of(word(i), {",", "::", "("})) continue;
        if (!is_name(i) || !is_idle_attribute(word(i))) return false;
    }
    return true;
}

}  // namespace porttool
