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
//
// Before Verdicts, MacroEdits, UnlikeNames, NewNames and LeftOutWords add what an unedited text came to mean; after all
// pairs, fold_findings() tells findings of one cause once.
#include "porttool/judge/judge.h"

#include <algorithm>

#include "porttool/judge/folded.h"
#include "porttool/judge/left_out_words.h"
#include "porttool/judge/lock_index.h"
#include "porttool/judge/macro_edits.h"
#include "porttool/judge/new_names.h"
#include "porttool/judge/pair_judge.h"
#include "porttool/judge/resolve.h"
#include "porttool/judge/shared_port.h"
#include "porttool/judge/unlike_names.h"
#include "porttool/judge/unwatched.h"
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

/// The pairs of the map. What finds them is large where they are many, and gone before they are judged.
std::vector<MappedPair> mapped_pairs(const Case& facts) {
    const LockIndex locks(facts.map, facts.lock, facts.source, facts.target);
    const Resolver source(facts.source, named_units(facts, locks, Side::Source), facts.base_text);
    const Resolver target(facts.target, named_units(facts, locks, Side::Target), facts.base_text);
    size_t count = 0;
    for (const MapPair& pair : facts.map.pairs) count += pair.targets.size();
    std::vector<MappedPair> out;
    out.reserve(count);
    for (const MapPair& pair : facts.map.pairs)
        for (const std::string& id : pair.targets)
            out.push_back({{pair.source, id},
                           pair.line,
                           {source.find(pair.source), target.find(id)},
                           locks.find(pair.source, id)});
    return out;
}

class Judge {
public:
    explicit Judge(const Case& facts)
        : facts_(facts),
          pairs_(mapped_pairs(facts)),
          renamed_(renamed_names()),
          shared_ports_(facts, renamed_, pairs_),
          findings_(facts.map),
          shared_files_(facts),
          pair_judge_(facts, renamed_, shared_files_, findings_),
          macro_edits_(facts, shared_files_, findings_),
          new_names_(facts, findings_),
          left_out_words_(facts, pair_judge_.dialect(), findings_),
          unlike_names_(facts, pair_judge_.dialect(), findings_),
          verdicts_(facts, findings_) {
        if (facts.in_project != nullptr && facts.in_project != &facts.lock)
            in_project_.emplace(facts.map, *facts.in_project, facts.source, facts.target);
    }

    Judgement run() {
        out_.reference = facts_.map.reference;
        out_.pairs.reserve(pairs_.size());
        for (const MappedPair& pair : pairs_) judge_pair(pair);
        find_unwatched(facts_, shared_files_, findings_, verdicts_, out_);
        macro_edits_.tell_how_many();
        new_names_.tell_how_many();
        left_out_words_.tell_how_many();
        verdicts_.report_idle();
        report_unreadable();
        report_unexplained_kernels();
        ease_orphans(findings_, out_.pairs, facts_.target);
        fold_findings(findings_, facts_.map);
        out_.findings = findings_.finish();
        out_.renamed = renamed_;
        return std::move(out_);
    }

private:
    BySide<RenamedNames> renamed_names() const {
        BySide<RenamedNames> out;
        for (const MappedPair& pair : pairs_)
            for (const Side side : kBothSides) out[side].note(pair.id[side], pair.units[side]);
        out.source.drop_taken(facts_.source);
        out.target.drop_taken(facts_.target);
        return out;
    }

    void judge_pair(const MappedPair& mapped) {
        const size_t first = findings_.size();
        out_.pairs.push_back(pair_judge_.judge(mapped.id, mapped.map_line, mapped.units, mapped.lock));
        JudgedPair& pair = out_.pairs.back();
        if (is_unrecorded(mapped)) report_unrecorded(pair);
        macro_edits_.judge(pair, mapped.lock.pair);
        const auto told_so_far = findings_.from(first);
        if (std::all_of(told_so_far.begin(), told_so_far.end(),
                        [](const Finding& finding) { return finding.level <= Level::Note; }))
            unlike_names_.judge(pair, mapped.lock.pair);
        new_names_.judge(pair);
        const auto told_by_now = findings_.from(first);
        left_out_words_.judge(pair, std::any_of(told_by_now.begin(), told_by_now.end(),
                                                [](const Finding& finding) { return finding.level > Level::Note; }));
        report_unexplained(pair);
        const Level told = weigh_shared_port(mapped, pair, first);
        report_other_parts(mapped, pair, first);
        const std::optional<Verdict> verdict = verdicts_.settle(pair, first, drifted_before(mapped));
        Level worst = told;
        for (const Finding& finding : findings_.from(first)) worst = std::max(worst, finding.level);
        pair.standing = standing_of(worst, verdict);
        ++out_.summary.pairs;
        ++counter(pair.standing);
        if (const LockedPair* line = line_of(mapped); line != nullptr)
            ++(line->state == kVerified || is_seen_same(pair) ? out_.summary.verified : out_.summary.recorded);
    }

    /// A pair in step whose sides ran and gave the same.
    bool is_seen_same(const JudgedPair& pair) const {
        return facts_.evidence != nullptr && pair.standing == PairStanding::InStep &&
               facts_.evidence->same.contains({pair.id.source, pair.id.target});
    }

    void report_unexplained(const JudgedPair& pair) {
        if (facts_.evidence == nullptr) return;
        const auto seen = facts_.evidence->pairs.find({pair.id.source, pair.id.target});
        if (seen != facts_.evidence->pairs.end()) findings_.add(Rule::UnexplainedDifference, pair, {}, seen->second);
    }

    /// Kernels that are in no pair.
    void report_unexplained_kernels() {
        if (facts_.evidence == nullptr) return;
        for (const auto& [kernel, message] : facts_.evidence->kernels)
            findings_.add(Rule::UnexplainedDifference, kernel).message = message;
    }

    /// The pair's line in the project's own lock.
    const LockedPair* line_of(const MappedPair& pair) const {
        return in_project_ ? in_project_->find(pair.id.source, pair.id.target).pair : pair.lock.pair;
    }

    /// True if today's texts are not those that the project's own lock has as in step: nothing that came after the
    /// merge base need be why.
    bool drifted_before(const MappedPair& pair) const {
        const LockedPair* line = in_project_ ? line_of(pair) : nullptr;
        const auto is_other = [](const UnitState* unit, const Fingerprints& recorded) {
            return unit != nullptr && unit->prints.renamed != recorded.renamed;
        };
        return line != nullptr && (is_other(pair.units.source.unit, line->source_prints) ||
                                   is_other(pair.units.target.unit, line->target_prints));
    }

    bool is_unrecorded(const MappedPair& pair) const {
        const bool is_there = pair.units.source.unit != nullptr && pair.units.target.unit != nullptr;
        return is_there && facts_.in_project != nullptr && line_of(pair) == nullptr;
    }

    /// A pair that somebody wrote into the map. What is known of its source from before does not go unsaid.
    void report_unrecorded(JudgedPair& pair) {
        if (looked_at_.empty())
            for (const LockedUnit& unit : facts_.lock.baseline) looked_at_.emplace(unit.id, unit.prints.written);
        const auto then = looked_at_.find(pair.unit.source->id);
        const bool edited = then != looked_at_.end() && then->second != pair.unit.source->prints.written;
        pair.changed = true;
        pair.equivalent = false;
        Finding& finding = findings_.add(Rule::Unrecorded, pair, {},
                                         std::string("this pair is in the map, but was never recorded as in step") +
                                             (edited ? "; its source changed since the lock was written" : ""));
        finding.remedy = "Compare the two once, then run: porttool accept " +
                         argument(pair.id.source + "=" + pair.id.target, finding);
    }

    /// Drops the finding that a shared port alone changed where another pair explains the edit, or has told of it.
    /// Returns what was told elsewhere.
    Level weigh_shared_port(const MappedPair& mapped, JudgedPair& pair, size_t first) {
        const Rule rule = shared_ports_.side() == Side::Source ? Rule::SourceChanged : Rule::TargetChanged;
        for (size_t i = first; i < findings_.size(); ++i) {
            Finding& finding = findings_.from(i).front();
            const bool is_edit = finding.change == ChangeKind::Semantic || finding.change == ChangeKind::Constant;
            if (finding.rule != rule || !is_edit || verdicts_.knows(pair)) continue;
            const SharedPorts::Worth worth = shared_ports_.worth_of(mapped);
            if (worth == SharedPorts::Worth::Tell) return Level::Off;
            const Level level = finding.level;
            findings_.drop(i);
            if (worth == SharedPorts::Worth::Told) return level;
            pair.changed = pair.equivalent = true;
            return Level::Off;
        }
        return Level::Off;
    }

    /// An edit of a shared port that lies in the parts of others is no port of this one's, whatever it says.
    void report_other_parts(const MappedPair& mapped, JudgedPair& pair, size_t first) {
        const auto all = findings_.from(first);
        const auto edits = std::find_if(all.begin(), all.end(),
                                        [](const Finding& finding) { return finding.rule == Rule::PortDiffers; });
        const bool differs = edits != all.end();
        if ((!differs && !pair_judge_.found_one_edit()) || (differs && edits->level >= Level::Error)) return;
        const EditOfParts edit = shared_ports_.edit_of(mapped);
        if (edit.kind == EditOfParts::Fits) return;
        if (differs && edit.kind == EditOfParts::PerhapsNot && edits->level >= Level::Warning) return;
        if (differs) findings_.drop(first + static_cast<size_t>(edits - all.begin()));
        const bool in_source = shared_ports_.side() == Side::Source;
        const std::string& whose = edit.owner->id[other(shared_ports_.side())];
        const bool is_sure = edit.kind == EditOfParts::OfOthers;
        Finding& finding = findings_.add(
            in_source ? Rule::TargetChanged : Rule::SourceChanged, pair, ChangeKind::Semantic,
            in_source ? "the port changed; its source did not: " : "the source changed; its port did not: ");
        finding.message += pair.id[shared_ports_.side()] +
                           (is_sure ? " was edited in the part of " : " may have been edited in the part of ") + whose;
        if (!is_sure) finding.level = std::min(finding.level, Level::Warning);
        pair.equivalent = false;
    }

    static PairStanding standing_of(Level worst, std::optional<Verdict> verdict) {
        if (verdict == Verdict::Defer) return PairStanding::Deferred;
        if (verdict == Verdict::Ignore) return PairStanding::Ignored;
        if (worst == Level::Error) return PairStanding::Drifted;
        return worst == Level::Warning ? PairStanding::Review : PairStanding::InStep;
    }

    size_t& counter(PairStanding standing) {
        Summary& summary = out_.summary;
        switch (standing) {
            case PairStanding::InStep:
                return summary.in_step;
            case PairStanding::Review:
                return summary.review;
            case PairStanding::Drifted:
                return summary.drifted;
            case PairStanding::Deferred:
                return summary.deferred;
            case PairStanding::Ignored:
                break;
        }
        return summary.ignored;
    }

    void report_unreadable() {
        for (const SkippedFile& file : facts_.skipped) {
            Finding& finding = findings_.add(Rule::Unreadable, file.file);
            finding.source = Place{file.file + ":@file", file.file, 1, 1};
            finding.message = file.file + " " + file.reason;
        }
    }

    const Case& facts_;
    std::vector<MappedPair> pairs_;
    BySide<RenamedNames> renamed_;
    SharedPorts shared_ports_;
    FindingList findings_;
    SharedFiles shared_files_;
    PairJudge pair_judge_;
    MacroEdits macro_edits_;
    NewNames new_names_;
    LeftOutWords left_out_words_;
    UnlikeNames unlike_names_;
    Verdicts verdicts_;
    std::optional<LockIndex> in_project_;     ///< of the project's own lock, where another stands in for it
    std::map<std::string, Print> looked_at_;  ///< units of the baseline, with the prints of their texts
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
