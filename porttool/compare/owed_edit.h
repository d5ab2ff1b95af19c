// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/compare/laid_edit.h"

namespace porttool {

/// False of an edit of one side alone, of more than a dozen words, of which little has to do with the other side's
/// text: it is in doubt that the other side owes it. True of words that are never silent, of the same words in another
/// order, of numbers in the place of numbers, and of short texts, whose words have their like by chance.
bool is_likely_owed(LaidEdit& laid);

/// What speaks for it, as a logistic regression sums it up: 0 is even for an edit of which nothing else is known. How
/// much of the two texts is alike, how much around the edit, how much of what went, and which of the names that came
/// are known there. Of texts that can be laid side by side.
///
///     before      y[i] = k * x[i];                                      port
///     now         y[i] = k * x[i] + lim;                                all that stands around has its like
///     or now      y[i] = k * x[i]; log.push(ticks, "done", where());    what came is beside it, of names unknown there
///     other       z[i] = k * x[i]; z[i] += lim;                         source
double weight_of_evidence(LaidEdit& laid);

}  // namespace porttool
