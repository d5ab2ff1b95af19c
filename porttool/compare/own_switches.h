// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/compare/meaning.h"

namespace porttool {

/// The texts of a pair without the lines that put something under a switch which only one side knows: what stands
/// between is said where the switch is on, which is when the two sides are to do the same. Switches with an `#else`
/// stay, and so does what is said where something is not defined. Nothing where there are none.
///
///     source      near ( p , n # ifdef HAS_FOG , fog # endif )        near ( p , n , fog )
///     port        near ( p , n , fog )                                as it is
struct SwitchlessTexts {
    std::vector<std::string> source_before, source_now, target_before, target_now;
};
std::optional<SwitchlessTexts> without_own_switches(const PairTexts& texts);

/// The macros that such switches of a side ask for, that its text did not know before, and asks for but once now: with
/// another letter it would be the same.
std::vector<std::string_view> lone_own_switches(const PairTexts& texts, Side side);

/// True if a name that came to a side stands under two such switches that ask for different macros: what one of them
/// declares, the other uses.
///
///     f ( # ifdef HAS_FOG int fog # endif ) { # ifdef HAS_SUN y = fog ; # endif }
bool own_switches_disagree(const PairTexts& texts, Side side);

}  // namespace porttool
