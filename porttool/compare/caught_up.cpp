// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/caught_up.h"

#include <algorithm>

#include "porttool/compare/lone_statements.h"
#include "porttool/compare/struct_fields.h"
#include "porttool/language/words.h"

namespace porttool {
namespace {

/// True if a struct says fewer words now that place its fields, or itself: `alignas`, `__attribute__`.
bool takes_layout(const Words& before, const Words& now) {
    const auto count = [](const Words& text) {
        constexpr Roles kPlaces = kTakesArguments | kGroupedQualifier;
        return std::count_if(text.begin(), text.end(),
                             [](std::string_view word) { return (roles_of(word) & kPlaces) == kPlaces; });
    };
    return count(now) < count(before);
}

}  // namespace

bool now_has_fields_of_other(const LoneTexts& texts, Side side, const Dialect& dialect,
                             const BySide<Language>& languages) {
    const Words before = data_fields(texts.before), now = data_fields(texts.now), there = data_fields(texts.other);
    const LoneStatements found({before, now, there}, side, dialect, languages);
    const auto& edit = found.edit;
    const bool head = !edit.gained.empty() && edit.gained.front() == 0;  // the struct's own: alignment, packing
    if (head || edit.gained.empty() || takes_layout(before, now)) return false;
    return found.in_common(edit.now) == found.in_common(edit.before) + edit.gained.size();
}

}  // namespace porttool
