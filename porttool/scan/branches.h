// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/scan/token.h"

namespace porttool {

/// Decides which branches of `#if ... #endif` take part in the matching of braces, and flags the tokens of the others:
/// - `#if 0`, and what follows `#if 1`: kDead;
/// - a group whose branches are each whole statements: all stay;
/// - a group that opens different heads or braces for one body: the first branch stays, or another one that is at least
///   four times longer; the rest is kOffStructure.
/// Takes linear time whatever the nesting.
void choose_branches(LexedText& lexed);

}  // namespace porttool
