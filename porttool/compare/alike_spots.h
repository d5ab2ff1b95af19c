// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/compare/edits.h"
#include "porttool/language/dialect.h"

namespace porttool {

/// True if edits of both sides put the same words into, or took them from, the same places, one after another, though
/// the statements around these say it in two ways. The places are told by laying the texts before side by side: on each
/// side the next word before or after a place must be the other's, with the same brackets between. What a function
/// takes may stand in another order and be of another type there, but for what came. Not a word may be left over.
///
///     source     out[i] = a / d * x[i];                        now    out[i] = a / (d + 0.5f) * x[i];
///     port       axpy(n, a / d, x, out);                       now    axpy(n, a / (d + 0.5f), x, out);
///                                                              not    axpy(n, (a + 0.5f) / d, x, out);
bool edits_spot_by_spot(const PairTexts& texts, const Dialect& dialect);

}  // namespace porttool
