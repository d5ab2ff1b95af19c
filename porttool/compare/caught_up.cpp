// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/caught_up.h"

#include "porttool/compare/lone_statements.h"
#include "porttool/compare/struct_fields.h"

namespace porttool {

bool now_has_fields_of_other(const LoneTexts& texts, Side side, const Dialect& dialect,
                             const BySide<Language>& languages) {
    const Words before = data_fields(texts.before), now = data_fields(texts.now), there = data_fields(texts.other);
    const LoneStatements found({before, now, there}, side, dialect, languages);
    const auto& edit = found.edit;
    const bool head = !edit.gained.empty() && edit.gained.front() == 0;  // the struct's own: alignment, packing
    if (head || edit.gained.empty()) return false;
    return found.in_common(edit.now) == found.in_common(edit.before) + edit.gained.size();
}

}  // namespace porttool
