// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "porttool/compare/compare_budget.h"
#include "porttool/compare/edits.h"
#include "porttool/language/dialect.h"
#include "porttool/language/language.h"
#include "porttool/normal/unit_state.h"
#include "porttool/scan/side.h"

namespace porttool {

/// A unit of a pair: when both sides were last in step, and now. `before` is looked at only where the side changed by
/// more than its looks, and is empty where it is not known.
struct PairedUnit {
    std::string_view id;
    UnitKind kind;      ///< now
    Language language;  ///< as the path of its file tells
    const Fingerprints &prints_before, &prints_now;
    const NormalText &before, &now;
};

/// How a pair stands, told by its texts alone; up to CaughtUp it is in step.
enum class Standing : uint8_t {
    InStep,         ///< neither side changed by more than its looks
    Idle,           ///< what was edited changes no value: qualifiers, hints, another spelling
    Equivalent,     ///< both sides changed, and alike
    CaughtUp,       ///< one side changed, to what the other says already
    SourceChanged,  ///< the source changed, the port did not
    TargetChanged,
    ValuesDiffer,  ///< a constant or struct changed, and the two sides have different values or fields now
    EditsDiffer,   ///< both sides changed, and not alike
};

/// What the texts of a pair mean to each other.
struct PairComparison {
    BySide<Change> changes;
    Standing standing = Standing::InStep;
    BySide<bool> idle = {false, false};       ///< the side's edit changes no value
    BySide<bool> respelled = {false, false};  ///< so because statements are spelled otherwise
    BySide<Edit> edits;  ///< what changes a value, as written; all of an idle edit; empty where a side did
                         ///< not change or `before` is not known
    std::vector<std::string> missing;  ///< EditsDiffer: sentences, what one side did and the other did not
    BySide<size_t> left = {0, 0};      ///< EditsDiffer: statements of each side's edit that the other's lacks
    bool displaced = false;            ///< EditsDiffer: what both did is the same, and surely at another place
    std::string values;                ///< ValuesDiffer: what each side has, a sentence
    bool differed_before = false;      ///< ValuesDiffer: so they did when they were last in step
    std::string not_compared;   ///< why the budget left the texts uncompared: edits, missing and values are then empty
    bool text_missing = false;  ///< the text before of a side that changed is not known
    CompareSize size;           ///< of the texts that there were to compare
};

/// True if a side changed by more than its looks, so that a pair is no longer in step by its prints alone.
inline bool is_edit(Change change) { return change > Change::Cosmetic; }

/// The one answer to what the texts of a pair mean to each other, for `check` and `history` alike; how much an edit
/// weighs is asked after it, by `check` alone (PairJudge::weigh_edit). Constants and structs are compared by
/// their values now where both sides changed, and an edit of one side alone is one even if the value stayed. Other
/// units are compared by their edits. What is not known or too long to compare is never in step.
PairComparison compare_pair(const BySide<PairedUnit>& pair, const Dialect& dialect, CompareBudget& budget);

}  // namespace porttool
