// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
//
// One finding, from pair to text. The map pairs `src/k.cu:shade` with `port/k.comp:shade`. The lock has the prints of
// both from the day when they were in step. Since then
//
//     src/k.cu      - t = b * 0.5f - a;      + t = b * 0.25f - a;
//     port/k.comp   - t = b * 0.5 - a;       + t = b * 0.75 - a;
//
// LockIndex finds the line of the lock, a Resolver for each side today's unit, also where it was renamed or moved.
// PairJudge sees by the prints that both changed, has the texts of that day read from portmap.base/ and asks
// compare_pair(), which says EditsDiffer and what each side has that the other has not. FindingList makes a finding of
// it: `port-differs`, an error unless [rules] says otherwise, with a fingerprint of rule and ids. Verdicts looks
// whether a person has settled it for just these texts; nobody has, so the pair counts as drifted, and `check` prints
//
//     src/k.cu:15: error: the source gained `t = b * 0.25f - a`; the port did not (and 1 more) [port-differs]
#include "porttool/judge/judge.h"

#include <algorithm>

#include "porttool/judge/lock_index.h"
#include "porttool/judge/pair_judge.h"
#include "porttool/judge/resolve.h"
#include "porttool/judge/unported.h"
#include "porttool/judge/verdicts.h"

namespace porttool {
namespace {

/// The units of one side that the map names, with their prints in the lock.
std::vector<NamedUnit> named_units(const Case& facts, const LockIndex& locks, Side side) {
    std::vector<NamedUnit> out;
    for (const MapPair& pair : facts.map.pairs)
        for (const std::string& target : pair.targets) {
            const LockedPair* lock = locks.find(pair.source, target).pair;
            const Fingerprints* prints = lock == nullptr        ? nullptr
                                         : side == Side::Source ? &lock->source_prints
                                                                : &lock->target_prints;
            out.push_back({side == Side::Source ? pair.source : target, prints});
        }
    return out;
}

class Judge {
public:
    explicit Judge(const Case& facts)
        : facts_(facts),
          locks_(facts.map, facts.lock, facts.source, facts.target),
          source_(facts.source, named_units(facts, locks_, Side::Source), facts.base_text),
          target_(facts.target, named_units(facts, locks_, Side::Target), facts.base_text),
          findings_(facts.map),
          pair_judge_(facts, findings_),
          verdicts_(facts, findings_) {}

    Judgement run() {
        for (const MapPair& pair : facts_.map.pairs)
            for (const std::string& target : pair.targets) judge_pair({pair.source, target}, pair.line);
        out_.summary.unported = find_unported(facts_, source_, findings_, verdicts_);
        verdicts_.report_idle();
        report_unreadable();
        out_.findings = findings_.finish();
        return std::move(out_);
    }

private:
    void judge_pair(const BySide<std::string>& id, int map_line) {
        const size_t first = findings_.size();
        const BySide<Resolved> units{source_.find(id.source), target_.find(id.target)};
        out_.pairs.push_back(pair_judge_.judge(id, map_line, units, locks_.find(id.source, id.target)));
        const std::optional<Verdict> verdict = verdicts_.settle(out_.pairs.back(), first);
        Level worst = Level::Off;
        for (const Finding& finding : findings_.from(first)) worst = std::max(worst, finding.level);
        ++out_.summary.pairs;
        ++counter(worst, verdict);
    }

    size_t& counter(Level worst, std::optional<Verdict> verdict) {
        Summary& summary = out_.summary;
        if (verdict == Verdict::Defer) return summary.deferred;
        if (verdict == Verdict::Ignore) return summary.ignored;
        if (worst == Level::Error) return summary.drifted;
        return worst == Level::Warning ? summary.review : summary.in_step;
    }

    void report_unreadable() {
        for (const SkippedFile& file : facts_.skipped) {
            Finding& finding = findings_.add(Rule::Unreadable, file.file);
            finding.source = Place{file.file + ":@file", file.file, 1, 1};
            finding.message = file.file + " " + file.reason;
        }
    }

    const Case& facts_;
    LockIndex locks_;
    Resolver source_, target_;
    FindingList findings_;
    PairJudge pair_judge_;
    Verdicts verdicts_;
    Judgement out_;
};

}  // namespace

Judgement judge(const Case& facts) { return Judge(facts).run(); }

GateResult Judgement::result() const {
    Level worst = Level::Off;
    for (const Finding& finding : findings)
        if (!finding.verdict) worst = std::max(worst, finding.level);
    if (worst == Level::Error) return GateResult::Drift;
    return worst == Level::Warning ? GateResult::Review : GateResult::InStep;
}

}  // namespace porttool
