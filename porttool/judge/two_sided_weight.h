// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/compare/compare_pair.h"
#include "porttool/judge/finding_list.h"
#include "porttool/judge/judge.h"
#include "porttool/judge/own_names.h"
#include "porttool/judge/swept_names.h"

namespace porttool {

/// How much it counts that both sides of a pair were edited, and not alike word for word.
class TwoSidedWeight {
public:
    /// All must outlive it; what is asked of the names is kept there.
    TwoSidedWeight(const Case& facts, const Dialect& dialect, OwnNames& own_names, SweptNames& swept_names)
        : facts_(facts), dialect_(dialect), own_names_(own_names), swept_names_(swept_names) {}

    /// Edits of both sides of a function that seem to be one are a note. Beside the text, how the files declare what it
    /// uses may have changed.
    void weigh(const JudgedPair& pair, const PairComparison& found, const BySide<NormalText>& before, Finding& finding);

private:
    void weigh_what_is_left(const JudgedPair& pair, const PairComparison& found, const PairTexts& texts,
                            Finding& finding);
    bool has_doubtful_switch(const PairTexts& texts, const JudgedPair& pair) const;

    const Case& facts_;
    const Dialect& dialect_;
    OwnNames& own_names_;
    SweptNames& swept_names_;
};

}  // namespace porttool
