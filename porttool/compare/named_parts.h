// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/language/dialect.h"
#include "porttool/language/language.h"
#include "porttool/normal/normal_text.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// True if all that an edit of a function did was to name a part, or to write one out that had a name:
///
///     y[3 * threadIdx.x] = a;        const int at = threadIdx.x;  y[3 * at] = a;
///
/// The part reads names that the function writes nowhere, and calls nothing but functions of mathematics. What the
/// name's type makes of it is not looked at, so this is no proof.
bool only_names_parts(const Words& before, const Words& now, UnitKind kind, Language language, const Dialect& dialect);

}  // namespace porttool
