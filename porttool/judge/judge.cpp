// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/judge.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <unordered_set>

#include "porttool/compare/compare_pair.h"
#include "porttool/judge/baseline_index.h"
#include "porttool/judge/lock_index.h"
#include "porttool/judge/resolve.h"
#include "porttool/judge/rules.h"
#include "porttool/judge/suppression_index.h"
#include "porttool/language/hazards.h"
#include "porttool/read/disk.h"
#include "porttool/read/id_patterns.h"
#include "porttool/text/sink/shell.h"

namespace porttool {
namespace {

ChangeKind kind_of(Change change) { return change == Change::Constant ? ChangeKind::Constant : ChangeKind::Semantic; }

class Judge {
public:
    explicit Judge(const Case& facts)
        : facts_(facts),
          dialect_(facts.map.dialect),
          locks_(facts.map, facts.lock, facts.source, facts.target),
          source_(facts.source, named_units(true), facts.base_text),
          target_(facts.target, named_units(false), facts.base_text),
          suppressions_(facts.suppressions) {
        for (const LedgerEntry& entry : facts.lock.ledger)
            if (entry.verdict != Verdict::Accept) ledger_[{entry.source, entry.target}].push_back(&entry);
        for (const SkippedFile& file : facts.skipped) unread_.emplace(file.file, file.reason);
        find_ignored();
    }

    Judgement run() {
        for (const MapPair& pair : facts_.map.pairs)
            for (const std::string& target : pair.targets) judge_pair(pair.source, target, pair.line);
        find_unported();
        find_unused_suppressions();
        find_idle_ignores();
        for (const SkippedFile& file : facts_.skipped) {
            Finding& finding = add(Rule::Unreadable, file.file, "");
            finding.source = Place{file.file + ":@file", file.file, 1, 1};
            finding.message = file.file + " " + file.reason;
        }
        std::sort(out_.findings.begin(), out_.findings.end(),
                  [](const Finding& a, const Finding& b) { return key(a) < key(b); });
        number_fingerprints();
        return std::move(out_);
    }

private:
    static std::tuple<std::string, uint32_t, std::string_view, std::string> key(const Finding& f) {
        const Place place = f.source ? *f.source : f.target.value_or(Place{});
        return {place.file, place.line, rule_name(f.rule), f.fingerprint};
    }

    /// Findings that are alike in all but their place, as two idle comments in one file, are told apart by their order.
    void number_fingerprints() {
        std::map<std::string, int> seen;
        for (Finding& finding : out_.findings) {
            const int number = ++seen[finding.fingerprint];
            if (number > 1) finding.fingerprint = fingerprint({{finding.fingerprint, 0}, {std::to_string(number), 0}});
        }
    }

    std::vector<NamedUnit> named_units(bool source) const {
        std::vector<NamedUnit> out;
        for (const MapPair& pair : facts_.map.pairs)
            for (const std::string& target : pair.targets) {
                const LockedPair* lock = locks_.find(pair.source, target).pair;
                const Fingerprints* prints = lock == nullptr ? nullptr
                                             : source        ? &lock->source_prints
                                                             : &lock->target_prints;
                out.push_back({source ? pair.source : target, prints});
            }
        return out;
    }

    Level level_of(Rule rule) const {
        const auto set = facts_.map.rules.find(rule);
        return set == facts_.map.rules.end() ? rule_row(rule).level : set->second;
    }

    /// An id as the argument of a command that a person pastes into a shell. What cannot be pasted, as a name with a
    /// line break, goes by the finding's fingerprint.
    static std::string argument(const std::string& id, const Finding& finding) {
        const bool is_list = id.starts_with('[') && id.ends_with(']');  // to the reader of the command line
        return can_be_pasted(id) && !is_list ? shell_quoted(id) : finding.fingerprint;
    }

    Finding& add(Rule rule, const std::string& source, const std::string& target) {
        Finding finding;
        finding.rule = rule;
        finding.level = level_of(rule);
        finding.remedy = rule_row(rule).remedy;
        const size_t id = finding.remedy.find("ID");
        finding.map_source = source;
        finding.map_target = target;
        finding.fingerprint = fingerprint({{std::string(rule_name(rule)), 0}, {source, 0}, {target, 0}});
        if (id != std::string::npos && !source.empty()) finding.remedy.replace(id, 2, argument(source, finding));
        out_.findings.push_back(std::move(finding));
        return out_.findings.back();
    }

    /// Ids keep the paths of their side; a place's file leads there from the root, also into another checkout.
    Place place_of(const UnitState& unit, bool source) const {
        return {unit.id, source ? unit.file : target_path(facts_.map, unit.file), unit.start_line, unit.end_line};
    }

    Finding& add_for(const JudgedPair& pair, Rule rule, std::optional<ChangeKind> change, const std::string& message) {
        Finding& finding = add(rule, pair.map_source, pair.map_target);
        if (pair.source != nullptr) finding.source = place_of(*pair.source, true);
        if (pair.target != nullptr) finding.target = place_of(*pair.target, false);
        finding.map_line = pair.map_line;
        finding.change = change;
        finding.message = message;
        return finding;
    }

    void judge_pair(const std::string& source_id, const std::string& target_id, int line) {
        const FoundLock found = locks_.find(source_id, target_id);
        const LockedPair* lock = found.pair;
        const Resolved source = source_.find(source_id), target = target_.find(target_id);
        JudgedPair pair{source_id, target_id, static_cast<uint32_t>(std::max(1, line)), source.unit, target.unit,
                        false,     false};
        const size_t before = out_.findings.size();
        if (lock == nullptr || !note_unread(pair, source.elsewhere, target.elsewhere)) examine(pair, lock);
        if (found.under_old_ids && out_.findings.size() == before && pair.source != nullptr && pair.target != nullptr)
            pair.changed = pair.equivalent = true;  // accept records it under its new ids
        if (source.elsewhere || target.elsewhere) note_moved(pair, source, target);
        settle(pair, before);
        out_.pairs.push_back(pair);
    }

    void note_moved(const JudgedPair& pair, const Resolved& source, const Resolved& target) {
        const UnitState& unit = source.elsewhere ? *source.unit : *target.unit;
        const std::string& old_id = source.elsewhere ? pair.map_source : pair.map_target;
        const bool same_file = old_id.substr(0, old_id.find(':')) == unit.file;
        Finding& finding = add_for(pair, source.elsewhere ? Rule::SourceChanged : Rule::TargetChanged,
                                   same_file ? ChangeKind::Rename : ChangeKind::Moved, old_id + " is now " + unit.id);
        finding.level = std::min(finding.level, Level::Note);
        finding.remedy = "Write the new id into portmap.toml and run: porttool accept " + argument(unit.id, finding);
    }

    /// Why the file of an id could not be read, or "".
    std::string unread_reason(const std::string& id) const {
        const auto file = unread_.find(split_id(id).first);
        return file == unread_.end() ? std::string() : file->second;
    }

    /// A recorded unit in a file that cannot be read is not gone, nor has it moved to where a copy of it stands: it may
    /// have been changed in any way. False if none is.
    bool note_unread(const JudgedPair& pair, bool source_elsewhere, bool target_elsewhere) {
        const bool no_source = pair.source == nullptr || source_elsewhere;
        const bool no_target = pair.target == nullptr || target_elsewhere;
        const std::string source = no_source ? unread_reason(pair.map_source) : "";
        const std::string target = no_target ? unread_reason(target_path(facts_.map, pair.map_target)) : "";
        if (source.empty() && target.empty()) return false;
        Finding& finding =
            add_for(pair, source.empty() ? Rule::DeadLink : Rule::SourceChanged, {},
                    source.empty() ? "the file of the port " + target : "the file of the source " + source);
        finding.remedy = "Make it readable; see the finding of 'unreadable' on that file";
        return true;
    }

    /// Adds what there is to find on one pair.
    void examine(JudgedPair& pair, const LockedPair* lock) {
        if (pair.target == nullptr && pair.source == nullptr) {
            add_for(pair, lock != nullptr ? Rule::Orphaned : Rule::DeadLink, ChangeKind::Removed,
                    lock != nullptr
                        ? "both sides of this pair are gone: " + pair.map_source + " and " + pair.map_target
                        : "the map names two units that are not there: " + pair.map_source + " and " + pair.map_target);
            return;
        }
        if (pair.target == nullptr) {
            add_for(pair, Rule::DeadLink, ChangeKind::Removed,
                    lock != nullptr ? "the port " + pair.map_target + " is gone"
                                    : "the map names a port that is not there: " + pair.map_target);
            return;
        }
        if (pair.source == nullptr) {
            if (lock != nullptr)
                add_for(pair, Rule::Orphaned, ChangeKind::Removed,
                        pair.map_source + " is gone; its port is still there");
            else
                add_for(pair, Rule::DeadLink, {}, "the map names a source unit that is not there: " + pair.map_source);
            return;
        }
        if (lock == nullptr) {
            pair.changed = true;
            Finding& finding =
                add_for(pair, Rule::TargetChanged, {}, "this pair is in the map, but was never recorded as in step");
            finding.remedy = "Compare the two once, then run: porttool accept " +
                             argument(pair.map_source + "=" + pair.map_target, finding);
            return;
        }
        compare(pair, *lock);
    }

    void compare(JudgedPair& pair, const LockedPair& lock) {
        const Change source = classify(lock.source_prints, pair.source->prints);
        const Change target = classify(lock.target_prints, pair.target->prints);
        pair.changed = source != Change::None || target != Change::None;
        pair.equivalent = pair.changed;
        if (!is_edit(source) && !is_edit(target)) return;
        const BySide<std::string> before{is_edit(source) ? facts_.base_text(lock.source_prints.written) : "",
                                         is_edit(target) ? facts_.base_text(lock.target_prints.written) : ""};
        const auto paired = [](const UnitState& unit, const Fingerprints& recorded, const std::string& text) {
            return PairedUnit{unit.id, unit.kind, language_of_path(unit.file), recorded, unit.prints, text, unit.text};
        };
        const PairComparison found = compare_pair({paired(*pair.source, lock.source_prints, before.source),
                                                   paired(*pair.target, lock.target_prints, before.target)},
                                                  dialect_, budget_);
        pair.equivalent = found.standing == Standing::Equivalent;
        note_hazards(pair, found.edits.source);
        report(pair, found, before);
    }

    void report(JudgedPair& pair, const PairComparison& found, const BySide<std::string>& before) {
        const bool one_sided = found.standing == Standing::SourceChanged || found.standing == Standing::TargetChanged;
        if (!found.not_compared.empty()) return report_unread(pair, found);
        if (one_sided) return report_one(pair, found, before);
        if (found.standing == Standing::EditsDiffer) return report_both(pair, found);
        if (found.standing != Standing::ValuesDiffer) return;
        const bool structs = pair.source->kind == UnitKind::Struct;
        const Change change = is_edit(found.changes.source) ? found.changes.source : found.changes.target;
        add_for(pair, structs ? Rule::LayoutDiffers : Rule::ConstantDiffers, kind_of(change), found.values);
    }

    /// What is too long to be compared is a finding all the same.
    void report_unread(const JudgedPair& pair, const PairComparison& found) {
        const bool both = found.standing == Standing::EditsDiffer, source = found.standing == Standing::SourceChanged;
        add_for(pair,
                both     ? Rule::PortDiffers
                : source ? Rule::SourceChanged
                         : Rule::TargetChanged,
                kind_of(std::max(found.changes.source, found.changes.target)),
                std::string(both     ? "both sides changed"
                            : source ? "the source changed; its port did not"
                                     : "the port changed; its source did not") +
                    "; the edit was not compared: " + found.not_compared);
    }

    /// Built-ins that the source's edit brings in and that mean different things in different dialects.
    void note_hazards(const JudgedPair& pair, const Edit& edit) {
        for (const std::string& hazard : hazards_of(edit.gained, edit.lost))
            add_for(pair, Rule::DialectHazard, {}, hazard).fingerprint =
                fingerprint({{std::string(rule_name(Rule::DialectHazard)), 0},
                             {pair.map_source, 0},
                             {pair.map_target, 0},
                             {hazard, 0}});
    }

    void report_one(JudgedPair& pair, const PairComparison& found, const BySide<std::string>& before) {
        const Side side = found.standing == Standing::SourceChanged ? Side::Source : Side::Target;
        const bool source = side == Side::Source;
        const Change change = found.changes[side];
        Finding& finding =
            add_for(pair, source ? Rule::SourceChanged : Rule::TargetChanged, kind_of(change),
                    source ? "the source changed; its port did not" : "the port changed; its source did not");
        if (found.text_missing) {
            finding.message += "; the earlier text is not in portmap.base/, or not as recorded: restore it from git";
            return;
        }
        for (const std::string& statement : found.edits[side].lost) finding.details.push_back("- " + statement);
        for (const std::string& statement : found.edits[side].gained) finding.details.push_back("+ " + statement);
        if (finding.details.empty()) finding.details.emplace_back("the statements were rearranged");
        finding.message += ": " + finding.details.front() + (finding.details.size() > 1 ? " ..." : "");
        if (change == Change::Semantic && facts_.same_code)
            soften(pair, finding, facts_.same_code(source ? *pair.source : *pair.target, source, before[side]));
    }

    /// An edit that does not reach the compiled code is no drift.
    static void soften(JudgedPair& pair, Finding& finding, const std::string& same) {
        if (same.empty()) return;
        pair.equivalent = true;
        finding.level = std::min(finding.level, Level::Note);
        finding.message += "; but it " + same;
        finding.remedy =
            "Nothing to port; to be rid of this note, run: porttool accept " + argument(pair.map_source, finding);
    }

    void report_both(JudgedPair& pair, const PairComparison& found) {
        const ChangeKind change = kind_of(std::max(found.changes.source, found.changes.target));
        if (found.text_missing) {
            add_for(pair, Rule::PortDiffers, change,
                    "both sides changed, and the texts to compare the edits by are not in portmap.base/, or not as "
                    "recorded");
            return;
        }
        Finding& finding = add_for(pair, Rule::PortDiffers, change, found.missing.front());
        finding.details = found.missing;
        if (finding.details.size() > 1)
            finding.message += " (and " + std::to_string(finding.details.size() - 1) + " more)";
    }

    /// Lets the ledger settle the pair's findings, and counts the pair.
    void settle(const JudgedPair& pair, size_t first) {
        ++out_.summary.pairs;
        const bool needed = out_.findings.size() > first;
        const LedgerEntry* verdict = nullptr;
        for (const LedgerEntry* entry : entries_of(pair.map_source, pair.map_target)) {
            if (!needed) {
                Finding& unused = add_for(pair, Rule::UnusedSuppression, {},
                                          "'" + word_of(*entry) + "' on this pair settles nothing: it is in step");
                unused.remedy = "Run: porttool accept " + argument(pair.map_source, unused);
                return count(first, {});
            }
            if (!is_of_these_texts(*entry, pair.source, pair.target)) {
                for (size_t i = first; i < out_.findings.size(); ++i)
                    out_.findings[i].message += " (edited since '" + word_of(*entry) + "')";
                continue;
            }
            if (entry->verdict == Verdict::Defer && entry->until < facts_.today) {
                add_for(pair, Rule::DeferralExpired, {}, "the deferral of this pair has expired");
                continue;
            }
            if (verdict == nullptr || entry->verdict == Verdict::Ignore) verdict = entry;
        }
        for (size_t i = first; i < out_.findings.size() && verdict != nullptr; ++i) {
            out_.findings[i].verdict = verdict->verdict;
            out_.findings[i].verdict_reason = verdict->reason;
        }
        if (verdict != nullptr)
            count(first, verdict->verdict);
        else
            count(first, suppress(first) ? std::optional(Verdict::Ignore) : std::nullopt);
    }

    /// The verdicts on a pair, or on a source unit without one (`target` empty). A record of an acceptance is none.
    const std::vector<const LedgerEntry*>& entries_of(const std::string& source, const std::string& target) {
        return ledger_[{source, target}];
    }

    static std::string word_of(const LedgerEntry& entry) { return std::string(verdict_name(entry.verdict)); }

    /// A verdict holds for the texts that it was given for; a side that is gone says nothing.
    static bool is_of_these_texts(const LedgerEntry& entry, const UnitState* source, const UnitState* target) {
        return (source == nullptr || entry.source_print == source->prints.written) &&
               (target == nullptr || entry.target_print == target->prints.written);
    }

    /// Lets comments settle findings from `first` on; true if they settle some and leave none open but notes.
    bool suppress(size_t first) {
        bool some = false, all = true;
        for (size_t i = first; i < out_.findings.size(); ++i) {
            Finding& finding = out_.findings[i];
            std::optional<size_t> settled;
            for (const std::optional<Place>* place : {&finding.source, &finding.target})
                if (*place) settled = std::max(settled, suppressions_.use(finding.rule, **place));
            if (settled) {
                finding.verdict = Verdict::Ignore;
                finding.verdict_reason = facts_.suppressions[*settled].comment.reason;
                finding.settled_in_source = true;
            }
            some = some || finding.verdict.has_value();
            all = all && (finding.verdict || finding.level <= Level::Note);
        }
        return some && all;
    }

    void find_unused_suppressions() {
        for (size_t k = 0; k < facts_.suppressions.size(); ++k) {
            if (suppressions_.is_used(k)) continue;
            const auto& [file, comment] = facts_.suppressions[k];
            Finding& finding = add(Rule::UnusedSuppression, file + ":" + comment.rule, "");
            finding.source = Place{file + ":@file", file, comment.line, comment.line};
            finding.message = "this comment ignores '" + comment.rule + "', of which there is no finding here";
            finding.remedy = "Remove the comment";
        }
    }

    void find_ignored() {
        std::vector<std::string> texts;
        for (const MapIgnore& ignore : facts_.map.ignores) texts.push_back(ignore.id);
        const IdPatterns patterns(texts);
        idle_ignores_.assign(texts.size(), true);
        for (const auto* side : {&facts_.source, &facts_.target})
            for (const auto& [id, unit] : *side)
                for (const size_t i : patterns.matching(id)) {
                    idle_ignores_[i] = false;
                    ignored_.insert(id);
                }
    }

    void find_idle_ignores() {
        for (size_t i = 0; i < idle_ignores_.size(); ++i) {
            if (!idle_ignores_[i]) continue;
            const MapIgnore& ignore = facts_.map.ignores[i];
            Finding& finding = add(Rule::UnusedSuppression, ignore.id, "");
            finding.map_line = static_cast<uint32_t>(std::max(1, ignore.line));
            finding.message = "[[ignore]] of '" + ignore.id + "' matches no unit of either side";
            finding.remedy = "Remove it from portmap.toml, or correct its id: porttool scan lists the ids";
        }
    }

    void count(size_t first, std::optional<Verdict> verdict) {
        Level worst = Level::Off;
        for (size_t i = first; i < out_.findings.size(); ++i) worst = std::max(worst, out_.findings[i].level);
        if (verdict == Verdict::Defer)
            ++out_.summary.deferred;
        else if (verdict == Verdict::Ignore)
            ++out_.summary.ignored;
        else if (worst == Level::Error)
            ++out_.summary.drifted;
        else if (worst == Level::Warning)
            ++out_.summary.review;
        else
            ++out_.summary.in_step;
    }

    void find_unported() {
        std::vector<const UnitState*> units;
        for (const auto& [id, unit] : facts_.source)
            if (!source_.taken(unit) && unit.kind != UnitKind::File) units.push_back(&unit);
        out_.summary.unported += units.size();
        const BaselineIndex baseline(facts_.lock.baseline, units);
        for (const UnitState* unit : units) judge_unported(*unit, baseline.find(*unit));
    }

    /// A unit of the baseline, or one that [[ignore]] names, raises nothing; where a person gave a reason for it there
    /// is a settled finding, for the reports that list those.
    void judge_unported(const UnitState& unit, const LockedUnit* baseline) {
        const size_t first = out_.findings.size();
        Finding& finding = add(Rule::Unported, unit.id, "");
        finding.source = place_of(unit, true);
        finding.change = ChangeKind::Added;
        finding.message = std::string(unit_kind_name(unit.kind)) + " " + unit.name + " has no port";
        if (baseline != nullptr || ignored_.contains(unit.id)) {
            suppress(first);  // a comment there says the same and is not idle
            Finding& settled = out_.findings[first];
            if (!settled.verdict && baseline != nullptr && !baseline->reason.empty()) {
                settled.verdict = Verdict::Ignore;
                settled.verdict_reason = baseline->reason;
            }
            if (!settled.verdict) out_.findings.pop_back();
            return;
        }
        for (const LedgerEntry* entry : entries_of(unit.id, "")) {
            if (entry->source_print != unit.prints.written) continue;
            if (entry->until < facts_.today) {
                Finding& expired = add(Rule::DeferralExpired, unit.id, "");
                expired.source = place_of(unit, true);
                expired.message = "the deferral of this unit has expired";
                continue;
            }
            out_.findings[first].verdict = entry->verdict;
            out_.findings[first].verdict_reason = entry->reason;
        }
        suppress(first);
    }

    const Case& facts_;
    Dialect dialect_;
    LockIndex locks_;
    Resolver source_, target_;
    std::map<std::pair<std::string, std::string>, std::vector<const LedgerEntry*>> ledger_;
    std::map<std::string, std::string> unread_;     ///< files, and why
    std::unordered_set<std::string_view> ignored_;  ///< ids of units that an [[ignore]] names
    std::vector<bool> idle_ignores_;
    SuppressionIndex suppressions_;
    CompareBudget budget_;
    Judgement out_;
};

}  // namespace

GateResult Judgement::result() const {
    Level worst = Level::Off;
    for (const Finding& finding : findings)
        if (!finding.verdict) worst = std::max(worst, finding.level);
    if (worst == Level::Error) return GateResult::Drift;
    return worst == Level::Warning ? GateResult::Review : GateResult::InStep;
}

std::string target_path(const MapFile& map, const std::string& path) {
    return map.target_root.empty() ? path : clean_path(join_path(map.target_root, path));
}

Judgement judge(const Case& facts) { return Judge(facts).run(); }

}  // namespace porttool
