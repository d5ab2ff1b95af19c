// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/compare/meaning.h"

namespace porttool {

/// A sentence where a statement that both sides gained, or lost, stands elsewhere among the uses of its own locals;
/// else
/// "". Asked of the text around, which may have no counterpart on the other side: how often the local is written, and
/// read, before the statement, and how many loops stand between. Of what ends something early it is asked what has
/// been written before, and what is skipped.
///
///     source              port
///     w = dist(a, b);     d = len(p - q);
///     w *= 2;             r = 1 / d;          `d *= 2` is read by nothing here, and `w *= 2` is
///     inv = rsqrt(w);     d *= 2;
///
/// Nothing is said of more than a few statements, and of names that are no locals of a single value.
std::string other_place_in_flow(const PairTexts& texts);

/// A sentence where a statement that both sides lost writes a local on one side that stands for another one than that
/// of the other side, as the source's text before tells in the words of the port; else "".
///
///     source    w *= 0.5;  m *= 0.5;           lost: the first
///     port      wet *= 0.5;  dirt *= 0.5;      lost: the second
std::string other_local_in_flow(const PairTexts& texts, const Words& source_in_words_of_target);

}  // namespace porttool
