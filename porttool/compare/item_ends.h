// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/compare/meaning.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

/// A kernel that a thread runs for one item ends with `return`; where the port goes over the items in a loop, what ends
/// one of them is `continue`, and `return` leaves all that are left.
///
///     kernel                              port                                      in the words below
///     if (i >= n) return;                 for (i = 0; i < n; ++i) {                 `return`
///     if (v < 0) return;                      if (v < 0) continue;                  `return`
///                                             if (v < 0) return;                    the mark of leaving a loop
///
/// The text with `return` for each `continue` of an outermost loop, and with a mark that nothing else has for each
/// `return` without a value in a loop. Bodies of lambdas are functions of their own.
std::vector<std::string> with_returns_for_items(const Words& text);

/// How many loops a text has.
size_t loops_of(const Words& text);

/// A sentence where the edit of one side came to leave a loop by `return` and that of the other did not; else "".
std::string other_ends_of_items(const PairTexts& texts);

}  // namespace porttool
