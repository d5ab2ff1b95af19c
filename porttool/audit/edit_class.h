// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Classes of edits that the other side seldom needs, told by the edit and the units that it stands in.
#pragma once

#include <set>
#include <string>

#include "porttool/audit/missing_edit.h"
#include "porttool/normal/unit_state.h"

namespace porttool {

/// True if nothing but plain names came to what a function takes, or went from it: `run(q, n)` became `run(q, n,
/// seed)`. `own`: the functions of the edited side, by the last part of their names. What the function does with it is
/// an edit of its own.
bool only_hands_on(const MissingPlace& place, const std::set<std::string>& own);

/// True for an option of a program: a label that is a character, where the unit reads the command line.
bool is_option(const MissingPlace& place, const UnitState& unit);

/// True for `if (p)` and `if (!p)`, alone or before other conditions, where the unit reads what `p` points to.
bool guards_pointer(const MissingPlace& place, const UnitState& unit);

/// True where only the bound changed by which results may be off: `if (fabs(a - b) > 0.01)`.
bool sets_tolerance(const MissingPlace& place);

/// True for a name of a type, `using T = ...`: each side has its own types.
bool names_type(const MissingPlace& place);

/// True for a statement that came and does no more than keep where something lies: `p = &box.min`.
bool keeps_address(const MissingPlace& place);

/// True for a label that is a number, where all labels of the other side are names.
bool numbers_label(const MissingPlace& place, const UnitState& there);

/// True for a guard against a launch of no threads: `if (num_blocks > 0)`.
bool guards_launch(const MissingPlace& place);

/// True where one local, which the unit has no longer, gave way to another: what that one holds is an edit of its own.
bool takes_other_local(const MissingPlace& place, const UnitState& unit);

/// True for a call that makes threads wait for each other, and nothing else.
bool only_waits(const WrittenStatement& statement);

}  // namespace porttool
