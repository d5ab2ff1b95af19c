// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/pair_judge.h"

#include <fmt/format.h>

#include <algorithm>

#include "porttool/compare/lone_edit.h"
#include "porttool/compare/member_elements.h"
#include "porttool/compare/paired_names.h"
#include "porttool/judge/weaken.h"
#include "porttool/language/hazards.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/prelude.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

ChangeKind kind_of(Change change) { return change == Change::Constant ? ChangeKind::Constant : ChangeKind::Semantic; }

Rule changed_rule(Side side) { return side == Side::Source ? Rule::SourceChanged : Rule::TargetChanged; }

std::string one_side_changed(Side side) {
    return side == Side::Source ? "the source changed; its port did not" : "the port changed; its source did not";
}

Side changed_side(const PairComparison& found) {
    return is_edit(found.changes.source) && !found.idle.source ? Side::Source : Side::Target;
}

Change larger_change(const PairComparison& found) { return std::max(found.changes.source, found.changes.target); }

/// The first statement that the edit took away or brought in for good; one that it did both with has only moved.
std::string headline_of(const Edit& edit, const std::string& otherwise) {
    const auto is_in = [](const std::vector<std::string>& list, const std::string& statement) {
        return std::find(list.begin(), list.end(), statement) != list.end();
    };
    constexpr size_t kMost = 200;
    for (size_t i = 0; i < std::min(edit.lost.size(), kMost); ++i)
        if (!is_in(edit.gained, edit.lost[i])) return "- " + edit.lost[i];
    for (size_t i = 0; i < std::min(edit.gained.size(), kMost); ++i)
        if (!is_in(edit.lost, edit.gained[i])) return "+ " + edit.gained[i];
    return otherwise;
}

/// The statements that an edit took away and brought in, and the first of them in the message.
void tell_edit(const Edit& edit, Finding& finding) {
    for (const std::string& statement : edit.lost) finding.details.push_back("- " + statement);
    for (const std::string& statement : edit.gained) finding.details.push_back("+ " + statement);
    if (finding.details.empty()) finding.details.emplace_back("the statements were rearranged");
    finding.message += ": " + headline_of(edit, finding.details.front()) + (finding.details.size() > 1 ? " ..." : "");
}

/// An edit that does not reach the compiled code is no drift. `same` says so, or is "".
void soften(JudgedPair& pair, Finding& finding, const std::string& same) {
    if (same.empty()) return;
    pair.equivalent = true;
    finding.level = std::min(finding.level, Level::Note);
    finding.message += "; but it " + same;
    finding.remedy =
        "Nothing to port; to be rid of this note, run: porttool accept " + argument(pair.id.source, finding);
}

}  // namespace

PairJudge::PairJudge(const Case& facts, const BySide<RenamedNames>& renamed, SharedFiles& shared_files,
                     FindingList& findings)
    : facts_(facts),
      renamed_(renamed),
      findings_(findings),
      dialect_(dialect_of_edits(facts.map)),
      own_names_(facts),
      swept_names_(facts),
      one_sided_(facts, dialect_, own_names_, swept_names_),
      two_sided_(facts, dialect_, own_names_, swept_names_),
      shared_files_(shared_files) {
    for (const SkippedFile& file : facts.skipped) unread_.emplace(file.file, file.reason);
}

JudgedPair PairJudge::judge(const BySide<std::string>& id, int map_line, const BySide<Resolved>& units,
                            const FoundLock& lock) {
    JudgedPair pair{id, {units.source.unit, units.target.unit}, static_cast<uint32_t>(std::max(1, map_line))};
    const size_t first = findings_.size();
    found_one_edit_ = false;
    if (!report_unread_file(pair, units, lock.pair != nullptr)) examine(pair, lock.pair);
    const bool both_there = pair.unit.source != nullptr && pair.unit.target != nullptr;
    if (lock.under_old_ids && findings_.size() == first && both_there)
        pair.changed = pair.equivalent = true;  // accept records it under its new ids
    if (units.source.elsewhere)
        report_moved(pair, Side::Source);
    else if (units.target.elsewhere)
        report_moved(pair, Side::Target);
    return pair;
}

bool PairJudge::report_unread_file(const JudgedPair& pair, const BySide<Resolved>& units, bool is_recorded) {
    const auto reason = [&](Side side, const std::string& path_of_id) {
        const bool is_there = units[side].unit != nullptr && !units[side].elsewhere;
        return is_there ? std::string() : unread_reason(path_of_id);
    };
    const std::string source = reason(Side::Source, pair.id.source);
    const std::string target = reason(Side::Target, target_path(facts_.map, pair.id.target));
    if (source.empty() && target.empty()) return false;
    const Rule of_source = is_recorded ? Rule::SourceChanged : Rule::DeadLink;  // that was in step with nothing
    Finding& finding = source.empty() ? findings_.add(Rule::DeadLink, pair, {}, "the file of the port " + target)
                                      : findings_.add(of_source, pair, {}, "the file of the source " + source);
    finding.remedy = "Make it readable; see the finding of 'unreadable' on that file";
    return true;
}

std::string PairJudge::unread_reason(const std::string& id) const {
    const auto file = unread_.find(split_id(id).first);
    return file == unread_.end() ? std::string() : file->second;
}

void PairJudge::examine(JudgedPair& pair, const LockedPair* lock) {
    if (pair.unit.source == nullptr || pair.unit.target == nullptr) {
        const size_t first = findings_.size();
        report_gone(pair, lock != nullptr);
        if (lock != nullptr) {
            weaken_if_shared(pair, first);
            weaken_if_gone_before(pair, first);
        }
        return;
    }
    if (lock != nullptr) compare(pair, *lock);
}

void PairJudge::report_gone(const JudgedPair& pair, bool is_recorded) {
    const auto& [source, target] = pair.id;
    const bool no_source = pair.unit.source == nullptr, no_target = pair.unit.target == nullptr;
    if (no_source && no_target) {
        Finding& finding = findings_.add(
            is_recorded ? Rule::Orphaned : Rule::DeadLink, pair, ChangeKind::Removed,
            (is_recorded ? "both sides of this pair are gone: " : "the map names two units that are not there: ") +
                source + " and " + target);
        finding.remedy = "Remove the [[pair]] from portmap.toml; if they were renamed, name the new ones there";
        if (is_recorded) finding.level = std::min(finding.level, Level::Note);  // both sides did the same
    } else if (is_recorded && no_target) {
        const bool is_original = facts_.map.reference == Reference::Target;
        Finding& finding = findings_.add(
            is_original ? Rule::Orphaned : Rule::DeadLink, pair, ChangeKind::Removed,
            is_original ? target + " is gone; " + source + " is still there" : "the port " + target + " is gone");
        if (const std::string call = call_in_place_of(target); !call.empty())
            finding.message += "; " + call + " is called there now";
        if (is_original)
            finding.remedy =
                "Remove " + source + " and its [[pair]], or name what took the place of " + target + " in portmap.toml";
    } else if (no_target) {
        findings_.add(Rule::DeadLink, pair, ChangeKind::Removed, "the map names a port that is not there: " + target);
    } else if (is_recorded && facts_.map.reference == Reference::Target) {
        findings_.add(Rule::DeadLink, pair, ChangeKind::Removed, source + " is gone; " + target + " is still there");
    } else if (is_recorded) {
        findings_.add(Rule::Orphaned, pair, ChangeKind::Removed, source + " is gone; its port is still there");
    } else {
        findings_.add(Rule::DeadLink, pair, {}, "the map names a source unit that is not there: " + source);
    }
}

/// A port that is gone where its folder includes the original's own file is that original now: there is
/// but one text, whatever was edited in it.
void PairJudge::weaken_if_shared(const JudgedPair& pair, size_t first) {
    if ((pair.unit.source == nullptr) == (pair.unit.target == nullptr)) return;
    const Side there = pair.unit.source != nullptr ? Side::Source : Side::Target;
    const UnitState& unit = *pair.unit[there];
    if (!shared_files_.folder_includes(other(there), split_id(pair.id[other(there)]).first, unit.file)) return;
    for (Finding& finding : findings_.from(first)) {
        finding.level = std::min(finding.level, Level::Note);
        finding.message += "; " + unit.file + " is included there in its place";
        finding.remedy = "Remove the [[pair]] from portmap.toml: both sides use one text now";
    }
}

/// Whoever removed it was told: to others it is no error, and an original that is gone no more than a note.
void PairJudge::weaken_if_gone_before(const JudgedPair& pair, size_t first) {
    if (facts_.gone_before == nullptr || !facts_.gone_before->contains({pair.id.source, pair.id.target})) return;
    for (Finding& finding : findings_.from(first)) {
        finding.level = std::min(finding.level, finding.rule == Rule::DeadLink ? Level::Warning : Level::Note);
        finding.message += ", as at the merge base";
    }
}

/// What the file of a port that is gone calls by another spelling of its name: a built-in that does the same, mostly.
std::string PairJudge::call_in_place_of(const std::string& gone) const {
    const auto [file, name] = split_id(gone);
    const std::string_view leaf = bare_leaf_of(name);
    for (const auto& [id, unit] : facts_.target)
        if (unit.file == file)
            if (const std::string_view call = respelled_call(unit.text, leaf); !call.empty()) return std::string(call);
    return {};
}

void PairJudge::report_moved(const JudgedPair& pair, Side side) {
    const UnitState& unit = *pair.unit[side];
    const std::string& old_id = pair.id[side];
    const bool same_file = old_id.substr(0, old_id.find(':')) == unit.file;
    Finding& finding = findings_.add(changed_rule(side), pair, same_file ? ChangeKind::Rename : ChangeKind::Moved,
                                     old_id + " is now " + unit.id);
    finding.level = std::min(finding.level, Level::Note);
    finding.remedy = "Write the new id into portmap.toml and run: porttool accept " + argument(unit.id, finding);
}

void PairJudge::compare(JudgedPair& pair, const LockedPair& lock) {
    const BySide<const Fingerprints*> recorded{&lock.source_prints, &lock.target_prints};
    BySide<Change> changes{};
    BySide<NormalText> before;
    for (const Side side : kBothSides) {
        changes[side] = classify(*recorded[side], pair.unit[side]->prints);
        if (is_edit(changes[side])) before[side] = renamed_[side].updated(facts_.base_text(recorded[side]->written));
    }
    pair.changed = pair.equivalent = std::max(changes.source, changes.target) != Change::None;
    if (!is_edit(changes.source) && !is_edit(changes.target)) return;
    const auto paired = [&](Side side) {
        const UnitState& unit = *pair.unit[side];
        return PairedUnit{unit.id,      unit.kind, language_of_path(unit.file), *recorded[side], unit.prints,
                          before[side], unit.text};
    };
    const PairComparison found = compare_pair({paired(Side::Source), paired(Side::Target)}, dialect_, budget_);
    pair.equivalent = found.standing <= Standing::CaughtUp;
    found_one_edit_ = found.standing == Standing::Equivalent;
    report_hazards(pair, found);
    if (!found.not_compared.empty()) return report_uncompared(pair, found);
    switch (found.standing) {
        case Standing::InStep:
        case Standing::Equivalent:
            return;
        case Standing::Idle:
            return report_idle(pair, found);
        case Standing::CaughtUp:
        case Standing::SourceChanged:
        case Standing::TargetChanged:
            return report_one(pair, found, before);
        case Standing::EditsDiffer:
            return report_both(pair, found, before);
        case Standing::ValuesDiffer:
            return report_values(pair, found);
    }
}

/// Built-ins that the source's edit brings in and that mean different things in different dialects; and of edits that
/// are one but for it, those that are less exact on one side.
void PairJudge::report_hazards(const JudgedPair& pair, const PairComparison& found) {
    const Edit& edit = found.edits.source;
    const auto language = [](const UnitState* unit) { return language_of_path(unit->file); };
    for (const std::string& hazard :
         hazards_of(edit.gained, edit.lost, language(pair.unit.source), language(pair.unit.target)))
        findings_.add(Rule::DialectHazard, pair, {}, hazard, hazard);
    if (found.standing != Standing::Equivalent) return;
    for (const std::string& hazard : precision_hazards(found.edits.source.gained, found.edits.target.gained))
        findings_.add(Rule::DialectHazard, pair, {}, hazard, hazard);
}

/// What is too long to be compared is a finding all the same.
void PairJudge::report_uncompared(const JudgedPair& pair, const PairComparison& found) {
    const bool both = found.standing == Standing::EditsDiffer;
    const Side side = changed_side(found);
    findings_.add(
        both ? Rule::PortDiffers : changed_rule(side), pair, kind_of(larger_change(found)),
        (both ? "both sides changed" : one_side_changed(side)) + "; the edit was not compared: " + found.not_compared);
}

void PairJudge::report_values(const JudgedPair& pair, const PairComparison& found) {
    const bool structs = pair.unit.source->kind == UnitKind::Struct;
    const Side side = is_edit(found.changes.source) ? Side::Source : Side::Target;
    Finding& finding = findings_.add(structs ? Rule::LayoutDiffers : Rule::ConstantDiffers, pair,
                                     kind_of(found.changes[side]), found.values);
    if (found.differed_before) weaken(pair, finding, Level::Warning, "they were not the same before, either");
}

/// Both may have such an edit; that of the source is told then.
void PairJudge::report_idle(const JudgedPair& pair, const PairComparison& found) {
    if (findings_.level_of(Rule::Qualifiers) == Level::Off) return;
    const Side side = is_edit(found.changes.source) ? Side::Source : Side::Target;
    Finding& finding = findings_.add(
        Rule::Qualifiers, pair, kind_of(found.changes[side]),
        side == Side::Source ? "an edit of the source changes no value" : "an edit of the port changes no value");
    tell_edit(found.edits[side], finding);
}

void PairJudge::report_one(JudgedPair& pair, const PairComparison& found, const BySide<NormalText>& before) {
    const Side side = changed_side(found);
    const Change change = found.changes[side];
    Finding& finding = findings_.add(changed_rule(side), pair, kind_of(change), one_side_changed(side));
    if (found.text_missing) {
        finding.message += "; the earlier text is not in portmap.base/, or not as recorded: restore it from git";
        return;
    }
    tell_edit(found.edits[side], finding);
    if (found.standing == Standing::CaughtUp)
        return soften(pair, finding,
                      side == Side::Source ? "says what the port says already" : "says what the source says already");
    const UnitState& unit = *pair.unit[side];
    const PlainStatements plain(unit.kind, language_of_path(unit.file), dialect_);
    const Words then = before[side].words(), now = unit.text.words();
    if (const auto macros = one_sided_.macros_of_another_build(unit, side, then); !macros.empty()) {
        const std::string macro(*macros.begin());
        // Who builds that side may ask for it by default: that stands in files that no glob names.
        weaken(pair, finding, Level::Warning,
               fmt::format("it only adds what is built with {}, which the other side never is", macro));
        finding.causes = {std::string(kBuiltWith) + macro};
        return;
    }
    if (!declaration_changes(then, now, plain).empty()) return;
    if (change == Change::Semantic && facts_.same_code && prelude_of(then) == prelude_of(now))
        soften(pair, finding, facts_.same_code(*pair.unit[side], side, before[side]));
    one_sided_.weigh(pair, side, before[side], finding);
}

void PairJudge::report_both(const JudgedPair& pair, const PairComparison& found, const BySide<NormalText>& before) {
    const ChangeKind change = kind_of(larger_change(found));
    if (found.text_missing) {
        findings_.add(Rule::PortDiffers, pair, change,
                      "both sides changed, and the texts to compare the edits by are not in portmap.base/, or not as "
                      "recorded");
        return;
    }
    Finding& finding = findings_.add(Rule::PortDiffers, pair, change, found.missing.front());
    finding.details = found.missing;
    if (finding.details.size() > 1) finding.message += " (and " + std::to_string(finding.details.size() - 1) + " more)";
    if (finding.level > Level::Note && !found.displaced) two_sided_.weigh(pair, found, before, finding);
}

}  // namespace porttool
