// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/ledger.h"

#include <algorithm>

#include "porttool/text/date.h"

namespace porttool {
namespace {

const LedgerEntry* entry_of(const LockFile& lock, const Finding& finding) {
    const Verdict wanted = finding.verdict.value_or(Verdict::Defer);  // an expired one is open again
    for (const LedgerEntry& entry : lock.ledger)
        if (entry.source == finding.map_source && entry.target == finding.map_target && entry.verdict == wanted)
            return &entry;
    return nullptr;
}

LedgerRow row_of(const Finding& finding, const LockFile& lock, const std::string& today) {
    LedgerRow row;
    row.finding = &finding;
    row.status = !finding.verdict ? "open" : finding.verdict == Verdict::Defer ? "deferred" : "ignored";
    row.reason = finding.verdict_reason;
    if (const LedgerEntry* entry = finding.settled_in_source ? nullptr : entry_of(lock, finding)) {
        row.owner = entry->owner;
        row.reason = entry->reason;
        if (entry->verdict == Verdict::Defer) {
            row.until = entry->until;
            row.days_left = days_between(today, entry->until);
        }
    }
    return row;
}

}  // namespace

DriftLedger drift_ledger(const Judgement& judgement, const LockFile& lock, const std::map<std::string, Age>& ages,
                         const std::string& today) {
    DriftLedger ledger;
    for (const Finding& finding : judgement.findings) {
        if (finding.level == Level::Off) continue;
        LedgerRow row = row_of(finding, lock, today);
        if (const auto age = ages.find(finding.fingerprint); age != ages.end()) {
            row.age_days = age->second.days;
            row.age_is_least = age->second.at_least;
        }
        ledger.rows.push_back(std::move(row));
    }
    const auto rank = [](const LedgerRow& row) { return row.status == "open" ? 0 : row.status == "deferred" ? 1 : 2; };
    std::stable_sort(ledger.rows.begin(), ledger.rows.end(),
                     [&](const LedgerRow& a, const LedgerRow& b) { return rank(a) < rank(b); });
    for (const LedgerEntry& entry : lock.ledger)
        if (entry.verdict == Verdict::Accept)
            ledger.accepted.push_back(
                {entry.source, entry.target, entry.until, entry.reason, days_between(entry.until, today)});
    return ledger;
}

}  // namespace porttool
