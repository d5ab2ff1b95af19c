// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/compare/edits.h"

namespace porttool {

/// True if a struct that changed alone has come to have fields of the other: each that came is there on the other side,
/// of the same type and at its place among the others, and none that went is. Not where it lost a word that places a
/// field (`alignas ( 16 ) float3 d ;`), which the other's language may place so by itself.
bool now_has_fields_of_other(const LoneTexts& texts, Side side, const Dialect& dialect,
                             const BySide<Language>& languages);

}  // namespace porttool
