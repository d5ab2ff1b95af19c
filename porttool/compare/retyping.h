// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "porttool/normal/normal_text.h"

namespace porttool {

/// What an edit gave another type of numbers.
struct Retyped {
    std::string name, before, now;
    auto operator<=>(const Retyped&) const = default;
};

/// Where an edit did nothing but that, and cast to such types: all of it, sorted; else nothing.
///
///     int i = first ( ) ;     size_t i = ( size_t ) first ( ) ;          { i, int, size_t }
std::optional<std::vector<Retyped>> only_retypes(const Words& before, const Words& now);

}  // namespace porttool
