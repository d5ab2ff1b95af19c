// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "porttool/compare/edits.h"
#include "porttool/language/dialect.h"

namespace porttool {

/// How statements that came, and those of the other side that have the same names, numbers and signs in the same order,
/// put these together.
///
///     x = lim / (x * 0.25f);        x = lim / x * 0.25f;          in other brackets
///     int q = x * lim;              float q = x * lim;            in other types
///     x = min(x, lim);              x = std::min<float>(x, lim);  alike
enum class Grouping : uint8_t { Alike, OtherTypes, OtherBrackets };

/// Of what came on both sides; the worst of all.
Grouping grouping_of_edits(const PairTexts& texts, const Dialect& dialect);

/// Of what came on one side, held against all that the other says.
Grouping grouping_of_edit(const LoneTexts& texts, const Dialect& dialect);

/// Of edits in each side's own words: true if what came on both sides, told in the words of the target as far as the
/// pair taught them, has another known name, another sign or another type where it is otherwise the same, or has the
/// same words in another order or in other brackets.
///
///     if (clear < 0.5f) light += 1;        if (sum < 0.5) left += 1;        where `light` was `sum` throughout
///     min(max(x, 0), lim)                  max(min(x, 0), lim)
bool edits_contradict(const PairTexts& learned, const Dialect& dialect);

}  // namespace porttool
