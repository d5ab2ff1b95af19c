// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "porttool/judge/finding_list.h"
#include "porttool/judge/judge.h"
#include "porttool/judge/own_names.h"
#include "porttool/judge/watched_units.h"
#include "porttool/language/dialect.h"
#include "porttool/normal/word_macros.h"

namespace porttool {

/// Finds the pairs whose edits are one, word for word, while a name in what came means one thing here and another one
/// there, in code that no pair watches:
///
///     source   float shape(float x) { return x * x; }      both sides gained   y += shape(x);
///     port     float shape(float x) { return x + x; }
///
/// So a function of which all but one statement is the same, a member that is another kind of number, and a type that
/// stands for another kind.
class UnlikeNames {
public:
    /// All must outlive it. `dialect`: that of edits.
    UnlikeNames(const Case& facts, const Dialect& dialect, FindingList& findings)
        : facts_(facts), findings_(findings), dialect_(dialect), own_names_(facts), watched_(facts.map) {}

    /// Adds the findings of a pair whose edits raised no more than notes. `line`: the pair's in the lock, or nullptr.
    void judge(JudgedPair& pair, const LockedPair* line);

private:
    struct Texts;

    void tell_functions(JudgedPair& pair, const Texts& texts);
    void tell_members(JudgedPair& pair, const Texts& texts);
    void tell_types(JudgedPair& pair, const Texts& texts);
    void tell(JudgedPair& pair, std::string_view word, const std::string& how);
    const UnitState* sole_unit(Side side, std::string_view name, bool is_struct);
    std::string number_type_for(const UnitState& unit, Side side, std::string_view word);

    const Case& facts_;
    FindingList& findings_;
    const Dialect& dialect_;
    OwnNames own_names_;
    WatchedUnits watched_;
    BySide<std::optional<WordMacros>> words_;  ///< filled when first asked
};

}  // namespace porttool
