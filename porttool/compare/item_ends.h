// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/compare/edits.h"
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
/// The text with `return` for each `continue` of an outermost loop that comes to its next item by itself, or after the
/// statement that takes it there, and with a mark that nothing else has for each `return` without a value in a loop.
/// Bodies of lambdas are functions of their own; a macro that heads a block is taken for a loop's.
std::vector<std::string> with_returns_for_items(const Words& text);

/// How many loops a text has.
size_t loops_of(const Words& text);

/// A sentence where the edits of the two sides end something else, in whatever words: one came to leave a loop by
/// `return` and the other did not, or from within more loops, or to leave a loop where the other leaves a switch; else
/// "".
std::string other_ends_of_items(const PairTexts& texts);

/// True if as much of each kind came and went on both sides that ends something early: `return`, `break`, `continue`;
/// also with `return` for the end of an item.
bool jump_alike(const PairTexts& texts);

/// True if an edit of one side brought no more of what ends something early than the other side has of that kind; also
/// with `return` for the end of an item.
bool jumps_arrive(const LoneTexts& texts);

}  // namespace porttool
