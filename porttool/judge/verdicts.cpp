// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/verdicts.h"

#include <algorithm>

#include "porttool/read/id_patterns.h"

namespace porttool {
namespace {

const Fingerprints* prints_of(const UnitState* unit) { return unit == nullptr ? nullptr : &unit->prints; }

std::string quoted(Verdict verdict) { return "'" + std::string(verdict_name(verdict)) + "'"; }

void settle_by(Finding& finding, Verdict verdict, const std::string& reason) {
    finding.verdict = verdict;
    finding.verdict_reason = reason;
}

}  // namespace

Verdicts::Verdicts(const Case& facts, FindingList& findings)
    : facts_(facts), findings_(findings), suppressions_(facts.suppressions) {
    for (const LedgerEntry& entry : facts.lock.ledger)
        if (entry.verdict != Verdict::Accept) ledger_[{entry.source, entry.target}].push_back(&entry);
    find_ignored();
}

std::optional<Verdict> Verdicts::settle(const JudgedPair& pair, size_t first, bool drifted_before) {
    const bool in_step = findings_.size() == first;
    if (in_step && drifted_before) return {};
    const LedgerEntry* holds = nullptr;
    for (const LedgerEntry* entry : entries_of(pair.id.source, pair.id.target)) {
        if (in_step) {
            Finding& idle = findings_.add(Rule::UnusedSuppression, pair, {},
                                          quoted(entry->verdict) + " on this pair settles nothing: it is in step");
            idle.remedy = "Run: porttool accept " + argument(pair.id.source, idle);
            return {};
        }
        if (!entry->is_of(prints_of(pair.unit.source), prints_of(pair.unit.target))) {
            for (Finding& finding : findings_.from(first))
                finding.message += " (edited since " + quoted(entry->verdict) + ")";
            continue;
        }
        if (entry->verdict == Verdict::Defer && entry->until < facts_.today) {
            findings_.add(Rule::DeferralExpired, pair, {}, "the deferral of this pair has expired");
            continue;
        }
        if (holds == nullptr || entry->verdict == Verdict::Ignore) holds = entry;
    }
    if (holds == nullptr) return suppress(first) ? std::optional(Verdict::Ignore) : std::nullopt;
    for (Finding& finding : findings_.from(first)) settle_by(finding, holds->verdict, holds->reason);
    return holds->verdict;
}

void Verdicts::settle_lone(const UnitState& unit, Side side, const LockedUnit* baseline) {
    const size_t first = findings_.size() - 1;
    if (baseline != nullptr || ignored_.contains(unit.id)) {
        suppress(first);  // a comment there says the same and is not idle
        Finding& finding = findings_.from(first).front();
        if (!finding.verdict && baseline != nullptr && !baseline->reason.empty())
            settle_by(finding, Verdict::Ignore, baseline->reason);
        if (!finding.verdict) findings_.drop_last();
        return;
    }
    const bool of_source = side == Side::Source;
    for (const LedgerEntry* entry : of_source ? entries_of(unit.id, "") : entries_of("", unit.id)) {
        if ((of_source ? entry->source_print : entry->target_print) != unit.prints.written) continue;
        if (entry->until < facts_.today)
            findings_.add(Rule::DeferralExpired, unit, side).message = "the deferral of this unit has expired";
        else
            settle_by(findings_.from(first).front(), entry->verdict, entry->reason);
    }
    suppress(first);
}

void Verdicts::report_idle() {
    report_idle_comments();
    report_idle_ignores();
}

const std::vector<const LedgerEntry*>& Verdicts::entries_of(const std::string& source,
                                                            const std::string& target) const {
    static const std::vector<const LedgerEntry*> kNone;
    if (ledger_.empty()) return kNone;
    const auto found = ledger_.find({source, target});
    return found == ledger_.end() ? kNone : found->second;
}

bool Verdicts::suppress(size_t first) {
    bool some = false, all = true;
    for (Finding& finding : findings_.from(first)) {
        std::optional<size_t> comment;
        if (finding.rule == Rule::Unpaired) {  // a comment from before it had a candidate still holds
            const Place& place = *(finding.side == Side::Source ? finding.source : finding.target);
            comment = std::max(suppressions_.use(finding.rule, place), suppressions_.use(Rule::Unported, place));
        } else {
            for (const std::optional<Place>* place : {&finding.source, &finding.target})
                if (*place) comment = std::max(comment, suppressions_.use(finding.rule, **place));
        }
        if (comment) {
            settle_by(finding, Verdict::Ignore, facts_.suppressions[*comment].comment.reason);
            finding.settled_in_source = true;
        }
        some = some || finding.verdict;
        all = all && (finding.verdict || finding.level <= Level::Note);
    }
    return some && all;
}

void Verdicts::find_ignored() {
    std::vector<std::string> texts;
    for (const MapIgnore& ignore : facts_.map.ignores) texts.push_back(ignore.id);
    const IdPatterns patterns(texts);
    idle_ignores_.assign(texts.size(), true);
    for (const auto* units : {&facts_.source, &facts_.target})
        for (const auto& [id, unit] : *units)
            for (const size_t i : patterns.matching(id)) {
                idle_ignores_[i] = false;
                ignored_.insert(id);
            }
}

void Verdicts::report_idle_comments() {
    for (size_t k = 0; k < facts_.suppressions.size(); ++k) {
        if (suppressions_.is_used(k)) continue;
        const auto& [file, comment] = facts_.suppressions[k];
        // Without evidence there is no such finding to settle.
        if (comment.rule == rule_name(Rule::UnexplainedDifference) && facts_.evidence == nullptr) continue;
        Finding& finding = findings_.add(Rule::UnusedSuppression, file + ":" + comment.rule);
        finding.source = Place{file + ":@file", file, comment.line, comment.line};
        finding.message = "this comment ignores '" + comment.rule + "', of which there is no finding here";
        finding.remedy = "Remove the comment";
    }
}

void Verdicts::report_idle_ignores() {
    for (size_t i = 0; i < idle_ignores_.size(); ++i) {
        if (!idle_ignores_[i]) continue;
        const MapIgnore& ignore = facts_.map.ignores[i];
        Finding& finding = findings_.add(Rule::UnusedSuppression, ignore.id);
        finding.map_line = static_cast<uint32_t>(std::max(1, ignore.line));
        finding.message = "[[ignore]] of '" + ignore.id + "' matches no unit of either side";
        finding.remedy = "Remove it from portmap.toml, or correct its id: porttool scan lists the ids";
    }
}

}  // namespace porttool
