// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/compare/meaning.h"

namespace porttool {

/// What a text tells the compiler to do with its lines, which is never silent: its pragmas, up to where they end or,
/// where that does not show, as far as they may reach.
std::vector<std::string> pragmas_of(const Words& text);

/// True if one side's edit gave something that stays another type (a parameter, by its place, what the function
/// returns, a local), or brought or took a pragma that counts, and the other side's did not do the same.
///
///     uint f ( uint x ) { uint h = x ; ...        source
///     uint f ( uint x ) { uint h = x ; ...        port, now  int f ( uint x )  or  uint f ( uint & x )  or  int h = x
///     ;
bool is_declared_otherwise(const PairTexts& texts);

}  // namespace porttool
