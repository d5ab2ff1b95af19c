// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/compare/edits.h"
#include "porttool/language/dialect.h"

namespace porttool {

/// True if an edit of one side alone brings it nearer to the other side's text, which has what the edit brings in and
/// nothing of what it takes away: two thirds of the names and numbers that came or went count that way, and no number
/// or operator stands alone now that had its like before, or is new. Less sure than now_says_what_other_says(): names
/// may differ where they stand for each other throughout. Edits of a few words are never that.
///
///     before      y = x[i];                                                        port
///     now         if (lim > 0) { const float c = damp(x, lim, 0.5f); y = c; }
///     other       if (lim > 0) { const float d = damp(x, lim, 0.5f); y = d; }      source
bool draws_level(const LoneTexts& texts, const Dialect& dialect);

}  // namespace porttool
