// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Classes of edits that the other side seldom needs, told by the edit and the units that it stands in.
#pragma once

#include <set>
#include <string>

#include "porttool/audit/missing_edit.h"
#include "porttool/normal/unit_state.h"
#include "porttool/scan/unit.h"

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

/// True for `a = - n * a` that was `a = - n * b`, where the unit has no `b` any longer: what stood in it stands in `a`.
bool goes_on_from_itself(const MissingPlace& place, const UnitState& unit);

/// True for what threads of one warp say to each other, and how many they are: each runtime has its own way.
bool exchanges_in_group(const MissingPlace& place);

/// True for a branch that the compiler takes, by what types a template is given.
bool asks_for_type(const MissingPlace& place);

/// True where only what a function of the side's own runtime takes became other: `cudaGraphInstantiate ( g )`.
bool is_taken_by_runtime(const MissingPlace& place);

/// True for what follows a lambda in the list of what a call takes: `, n , a . get_data ( ) )`.
bool lies_behind_lambda(const MissingPlace& place);

/// True where it came to be asked whether there is memory: `&& a -> get_values ( )`.
bool asks_for_memory(const MissingPlace& place);

/// True where a name took the place of an expression, and the other side knows the name, too: it may hold just that.
bool names_expression(const MissingPlace& place, const UnitState& there);

/// True where the other side says a macro that the edit does away with, and a host gives it a value as it builds the
/// other side's code. `given`: as add_macros_of_host() has them.
bool takes_macro_of_host(const MissingPlace& place, const std::set<std::string>& given);

/// The macros that a text defines for a compiler that it calls: `"-DSTEPS="`.
void add_macros_of_host(const ScannedFile& file, std::set<std::string>& out);

/// True for a call that makes threads wait for each other, and nothing else.
bool only_waits(const WrittenStatement& statement);

}  // namespace porttool
