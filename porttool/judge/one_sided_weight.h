// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/compare/added_branches.h"
#include "porttool/compare/laid_edit.h"
#include "porttool/compare/respelled_calls.h"
#include "porttool/judge/finding_list.h"
#include "porttool/judge/judge.h"
#include "porttool/judge/own_names.h"
#include "porttool/judge/swept_names.h"
#include "porttool/judge/watched_units.h"
#include "porttool/judge/words_of_ports.h"

namespace porttool {

/// How much an edit of one side alone counts, by what it did and what the other side's text has to do with it.
///
///     error      y[i] = x[i] * 0.5f;  ->  y[i] = x[i] * 0.25f;       the other side has its like
///     warning    what little of the other side's text is like, or has most of
///     note       what surely needs no port: a name that nothing reads, what is printed, another spelling of a call
class OneSidedWeight {
public:
    /// All must outlive it; what is asked of the names is kept there.
    OneSidedWeight(const Case& facts, const Dialect& dialect, OwnNames& own_names, SweptNames& swept_names)
        : facts_(facts),
          dialect_(dialect),
          own_names_(own_names),
          swept_names_(swept_names),
          watched_(facts.map),
          words_of_ports_(facts, dialect, own_names) {}

    /// The macros for which an edit added texts, where it did nothing else, neither in the unit nor in what the file
    /// declares for it, and only who builds that side asks for them; else none.
    std::set<std::string_view> macros_of_another_build(const UnitState& unit, Side side, const Words& before);

    /// An edit that most likely needs no port is a note, one of a word or two a warning.
    void weigh(JudgedPair& pair, Side side, const NormalText& before, Finding& finding);

private:
    void weaken_unread(JudgedPair& pair, Side side, const LoneTexts& texts, Finding& finding, const std::string& why);
    std::string say_same_anyway(const LoneTexts& texts, const Words& before, const UnitState& now,
                                Language language) const;
    bool call_the_same(const std::vector<RespelledCall>& calls, Side side, const Words& there);
    bool doubt_unless_owed(const JudgedPair& pair, LaidEdit& laid, const std::string& why, Finding& finding);
    void weigh_ground(JudgedPair& pair, Side side, LaidEdit& laid, Finding& finding);

    const Case& facts_;
    const Dialect& dialect_;
    OwnNames& own_names_;
    SweptNames& swept_names_;
    WatchedUnits watched_;
    WordsOfPorts words_of_ports_;
};

}  // namespace porttool
