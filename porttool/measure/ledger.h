// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "porttool/judge/judge.h"

namespace porttool {

/// A finding with what a person said about it.
struct LedgerRow {
    const Finding* finding = nullptr;
    std::string status;  ///< open, deferred or ignored
    std::string owner, until, reason;
    std::optional<int> age_days;   ///< since the change that it is about was committed; none without git
    bool age_is_least = false;     ///< the history begins later: it is at least so old
    std::optional<int> days_left;  ///< of a deferral; negative where it has expired
};

/// An acceptance that gave a reason.
struct AcceptedRow {
    std::string source, target, date, reason;
    std::optional<int> age_days;
};

struct DriftLedger {
    std::vector<LedgerRow> rows;  ///< open, then deferred, then ignored; in the judgement's order
    std::vector<AcceptedRow> accepted;
};

/// How long a finding has stood.
struct Age {
    int days = 0;
    bool at_least = false;
};

/// `ages` by the fingerprints of findings; `today` is YYYY-MM-DD.
DriftLedger drift_ledger(const Judgement& judgement, const LockFile& lock, const std::map<std::string, Age>& ages,
                         const std::string& today);

}  // namespace porttool
