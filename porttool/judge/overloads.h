// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/normal/unit_state.h"

namespace porttool {

/// What can be said without a compiler of which calls a function takes.
struct Signature {
    std::string scope;               ///< of `a::B::f#2` it is `a::B::`
    std::string leaf;                ///< `f`
    std::string written;             ///< the parameters as they stand there
    std::vector<std::string> types;  ///< of the parameters, without names, `const` and references
    bool takes_anything = false;     ///< a template, `auto`, `...`, defaults of arguments
    bool is_function = true;

    bool operator==(const Signature&) const = default;
};

Signature signature_of(const UnitState& unit);

/// True if a call may mean either by its arguments' types: as many, each of the same type or both numbers; a template
/// may take any.
bool compete(const Signature& a, const Signature& b);

/// How many parts the list has that opens at a place; nothing where it is open at its end or long, or one says `...` or
/// `=`. Calls stand within calls: a list is read once for each of them.
std::optional<size_t> parts_of_list(const NormalText& text, size_t open);

/// False where a call gives a function more or fewer arguments than it takes: it is another overload's.
bool may_take(const UnitState& unit, const NormalText& text, size_t call);

}  // namespace porttool
