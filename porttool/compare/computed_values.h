// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/language/dialect.h"
#include "porttool/language/language.h"
#include "porttool/normal/normal_text.h"
#include "porttool/scan/side.h"

namespace porttool {

/// True if the two functions of a pair are sure to compute the same, after translation into one vocabulary: see
/// give_the_same(). Texts are in normal form; of more than 5,000 words nothing is sure.
bool compute_alike(const BySide<Words>& texts, const Dialect& dialect, const BySide<Language>& languages);

/// True if a function is sure to compute what it computed before its edit. What is no plain number may have operators
/// of its own making here.
bool computes_as_before(const Words& before, const Words& now, const Dialect& dialect, Language language);

}  // namespace porttool
