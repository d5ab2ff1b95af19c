// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/compare/edits.h"
#include "porttool/compare/plain_statement.h"
#include "porttool/language/dialect.h"
#include "porttool/language/language.h"
#include "porttool/normal/normal_text.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// What the edit of one side is by itself.
struct LoneEdit {
    bool means_nothing = false;  ///< it changes no value, and that is sure
    bool respells = false;       ///< so because statements are spelled otherwise, which the other side may follow
    Edit edit;                   ///< what it did beyond that, as written; all of it if that is nothing
};

/// Reads one side's edit by the rules of PlainStatements and without_hints(). `before` and `now`: tokens in normal form
/// of a unit of that kind and language. `names_count`: a macro takes locals as they are spelled, so that their names
/// are no matter of taste.
///
///     before    inline float @ (float* a) { return a[0]; }
///     now       float @ (const float* a) { return a[0]; }        means nothing
///     or now    float @ (const float* a) { return a[1]; }        `return a[1]` for `return a[0]`, no word of the head
LoneEdit lone_edit(const Words& before, const Words& now, UnitKind kind, Language language, const Dialect& dialect,
                   bool names_count);

/// What an edit did to how its file declares what the unit uses, and to what the file says of the unit itself: the
/// words that went and came, without names, sorted. Two sides that did the same have equal lists.
std::vector<std::string> declaration_changes(const Words& before, const Words& now, const PlainStatements& plain);

/// True for the name of a macro that says that something is not used: `UNUSED`, `Q_UNUSED`, `UNUSED_PARAM`. A function
/// may do anything.
bool says_unused(std::string_view name);

}  // namespace porttool
