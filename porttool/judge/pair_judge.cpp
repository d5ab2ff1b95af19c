// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/pair_judge.h"

#include <algorithm>

#include "porttool/compare/alike_spots.h"
#include "porttool/compare/asides.h"
#include "porttool/compare/common_ground.h"
#include "porttool/compare/computed_values.h"
#include "porttool/compare/declared_otherwise.h"
#include "porttool/compare/grouping.h"
#include "porttool/compare/guarded_words.h"
#include "porttool/compare/laid_edit.h"
#include "porttool/compare/learned_words.h"
#include "porttool/compare/lone_edit.h"
#include "porttool/compare/member_elements.h"
#include "porttool/compare/named_parts.h"
#include "porttool/compare/other_rounding.h"
#include "porttool/compare/owed_edit.h"
#include "porttool/compare/own_fields.h"
#include "porttool/compare/own_switches.h"
#include "porttool/compare/own_words.h"
#include "porttool/compare/paired_names.h"
#include "porttool/compare/plain_choices.h"
#include "porttool/compare/retyping.h"
#include "porttool/compare/runtime_calls.h"
#include "porttool/compare/runtime_upkeep.h"
#include "porttool/compare/runtime_versions.h"
#include "porttool/compare/same_names.h"
#include "porttool/compare/settled_edits.h"
#include "porttool/compare/statement_edit.h"
#include "porttool/compare/switch_arms.h"
#include "porttool/compare/switch_cases.h"
#include "porttool/compare/unread_locals.h"
#include "porttool/judge/same_edit_beside.h"
#include "porttool/language/hazards.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/prelude.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

ChangeKind kind_of(Change change) { return change == Change::Constant ? ChangeKind::Constant : ChangeKind::Semantic; }

constexpr size_t kMostChosen = 24;  ///< differences, of which choices in another manner are all there is
constexpr size_t kNoSlip = 12;      ///< words of an edit that nobody makes by mistake

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

/// Says of an edit why it most likely needs no port.
void weaken(const JudgedPair& pair, Finding& finding, Level level, const std::string& why) {
    finding.level = std::min(finding.level, level);
    finding.message += "; but " + why;
    finding.remedy =
        "Compare the two once; if nothing is left to port, run: porttool accept " + argument(pair.id.source, finding);
}

/// What the other side most likely does not owe, though nothing proves it: told once for all such edits.
void doubt(const JudgedPair& pair, Finding& finding, const std::string& why) {
    weaken(pair, finding, Level::Warning, why);
    finding.causes = {std::string(kInDoubt)};
}

/// What a person would change by mistake.
bool is_of_few_words(const Words& before, const Words& now) {
    constexpr size_t kFew = 4;
    return words_edited(before, now) < kFew;
}

/// True if an edit only took words away.
bool only_takes(const Words& before, const Words& now) {
    const std::vector<DiffStep> steps = diff(before, now);
    return std::none_of(steps.begin(), steps.end(), [](const DiffStep& step) { return step.kind == DiffStep::Add; });
}

/// True if only quoted texts came and went.
bool only_rewords_texts(const Words& before, const Words& now) {
    const std::vector<DiffStep> steps = diff(before, now);
    return std::all_of(steps.begin(), steps.end(), [&](const DiffStep& step) {
        return step.kind == DiffStep::Keep ||
               (step.kind == DiffStep::Add ? now[step.now] : before[step.before]).starts_with('"');
    });
}

/// True if the edits brought one side more statements than the other, and both texts are sure to compute the same now.
/// Statements that stand for each other one by one are held to their words.
bool compute_alike_now(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages) {
    const auto gained = [](const Words& before, const Words& now) {
        const auto as_written = [](const Words& words, bool) {
            return std::vector<std::string>(words.begin(), words.end());
        };
        return statement_edit(before, now, as_written).gained.size();
    };
    if (gained(texts.source_before, texts.source_now) == gained(texts.target_before, texts.target_now)) return false;
    const Words none;
    const BySide<Words> now{texts.source_now, texts.target_now};
    return guarded_difference({none, now.source, none, now.target}).empty() && compute_alike(now, dialect, languages);
}

/// True if edits of both sides are one but for what is computed in one step or in several.
bool differ_in_rounding(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages) {
    std::vector<std::string> said[4];
    Words words[4];
    const Words* texts_of_pair[] = {&texts.source_before, &texts.source_now, &texts.target_before, &texts.target_now};
    bool any = false;
    for (size_t i = 0; i < 4; ++i) {
        said[i] = with_other_rounding(*texts_of_pair[i], dialect);
        words[i].assign(said[i].begin(), said[i].end());
        any = any || words[i] != *texts_of_pair[i];
    }
    return any && compare_edits({words[0], words[1], words[2], words[3]}, dialect, languages).equivalent;
}

/// True if edits of both sides are one but for how they choose between values, and what is computed in one step or in
/// several.
bool choose_alike(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages) {
    std::vector<std::string> said[4];
    Words words[4];
    const MemberElements elements(texts);
    const BySide<std::vector<std::string>> then{elements.written(texts.source_before),
                                                elements.written(texts.target_before)},
        now{elements.written(texts.source_now), elements.written(texts.target_now)};
    const Words in_members[] = {{then.source.begin(), then.source.end()},
                                {now.source.begin(), now.source.end()},
                                {then.target.begin(), then.target.end()},
                                {now.target.begin(), now.target.end()}};
    const Words* texts_of_pair[] = {&texts.source_before, &texts.source_now, &texts.target_before, &texts.target_now};
    bool any = false;
    for (size_t i = 0; i < 4; ++i) {
        const std::vector<std::string> plain =
            with_plain_choices(in_members[i], i < 2 ? languages.source : languages.target);
        const Words plain_words(plain.begin(), plain.end());
        any = any || plain_words != *texts_of_pair[i];
        said[i] = with_other_rounding(plain_words, dialect);
        words[i].assign(said[i].begin(), said[i].end());
    }
    return any && compare_edits({words[0], words[1], words[2], words[3]}, dialect, languages).equivalent;
}

/// True if both edits did nothing but give things another type, and the same one.
bool retype_alike(const PairTexts& texts) {
    const auto source = only_retypes(texts.source_before, texts.source_now);
    return source && source == only_retypes(texts.target_before, texts.target_now);
}

/// True if edits of both sides are for the most part one where branches for the compiler that only one side has are
/// taken for on.
bool are_one_without_switches(const SwitchlessTexts& said, const Dialect& dialect, const BySide<Language>& languages) {
    const auto words = [](const std::vector<std::string>& text) { return Words(text.begin(), text.end()); };
    const Words source_before = words(said.source_before), source_now = words(said.source_now),
                target_before = words(said.target_before), target_now = words(said.target_now);
    const PairTexts texts{source_before, source_now, target_before, target_now};
    return compare_edits(texts, dialect, languages).equivalent || edits_spot_by_spot(texts, dialect) ||
           (edits_in_own_words(texts, dialect) && grouping_of_edits(texts, dialect) == Grouping::Alike &&
            !edits_contradict(texts, dialect));
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
      watched_(facts.map),
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
    if (const AddedBranches added = added_for_another_build(unit, side, then); !added.macros.empty()) {
        const std::string macro(*added.macros.begin());
        weaken(pair, finding, added.reckons_otherwise ? Level::Warning : Level::Note,
               fmt::format("it only adds what is built with {}, which the other side never is", macro));
        finding.causes = {std::string(kBuiltWith) + macro};
        return;
    }
    if (!declaration_changes(then, now, plain).empty()) return;
    if (change == Change::Semantic && facts_.same_code && prelude_of(then) == prelude_of(now))
        soften(pair, finding, facts_.same_code(*pair.unit[side], side, before[side]));
    weigh_edit(pair, side, before[side], finding);
}

/// What an edit added for some macros, where it did nothing else, neither in the unit nor in what the file declares for
/// it, and only who builds that side asks for them; else nothing.
AddedBranches PairJudge::added_for_another_build(const UnitState& unit, Side side, const Words& before) const {
    const Words now = unit.text.words();
    AddedBranches added = added_branches(without_prelude(before), without_prelude(now));
    if (added.macros.empty() || !std::all_of(added.macros.begin(), added.macros.end(), [&](std::string_view macro) {
            return own_names_.is_asked_for_elsewhere(std::string(macro), side);
        }))
        return {};
    if (prelude_of(before) == prelude_of(now)) return added;
    const FilesOfSide& files = (*facts_.files)[side];
    for (size_t i = 0; i < files.size(); ++i) {
        if (files.path(i) != unit.file) continue;
        const ScannedFile file = scan_text(unit.file, without_macros(files.scanned(i).lexed, added.macros));
        for (const Unit& built : file.units)
            if (unit_id(file, built) == unit.id) {
                const UnitState state = unit_state(file, built);
                return prelude_of(state.text.words()) == prelude_of(before) ? added : AddedBranches();
            }
    }
    return {};
}

/// True if both names of each call are most likely one function's: of a library, and as exact, or of the side itself,
/// where it bore the name from before. A function under a new name that only looks like the old one is another. A macro
/// is what it looks like where the other side's text says the function that it became.
bool PairJudge::call_the_same(const std::vector<RespelledCall>& calls, Side side, const Words& there) const {
    const auto was_called = [&](std::string_view name, const UnitState& unit) {
        return std::any_of(facts_.lock.baseline.begin(), facts_.lock.baseline.end(), [&](const LockedUnit& line) {
            return line.prints.renamed == unit.prints.renamed && bare_leaf_of(split_id(line.id).second) == name;
        });
    };
    const auto is_there = [&](std::string_view name) {
        return std::find(there.begin(), there.end(), name) != there.end();
    };
    return std::all_of(calls.begin(), calls.end(), [&](const RespelledCall& call) {
        if (call.of_macro && (!is_there(call.now) || is_there(call.before))) return false;
        const std::vector<const UnitState*>*was = own_names_.of(side, call.before), *is = own_names_.of(side, call.now);
        if (was != nullptr) return false;
        if (is != nullptr) return was_called(call.before, *is->front());
        const std::string before = std::string(call.before) + "()", now = std::string(call.now) + "()";
        return precision_hazards({before}, {now}).empty();
    });
}

/// An edit that most likely needs no port is a note, one of a word or two a warning.
void PairJudge::weigh_edit(JudgedPair& pair, Side side, const NormalText& before, Finding& finding) const {
    const UnitState &now = *pair.unit[side], &there = *pair.unit[other(side)];
    const bool is_code = now.kind == UnitKind::Function || now.kind == UnitKind::Kernel;
    const bool structs = now.kind == UnitKind::Struct && there.kind == UnitKind::Struct;
    if (finding.level <= Level::Note || (!is_code && !structs)) return;
    const LoneTexts texts{without_prelude(before.words()), without_prelude(now.text.words()),
                          without_prelude(there.text.words())};
    LaidEdit laid(texts, dialect_);
    if (const auto names = only_qualified_names(texts.before, texts.now)) {
        if (std::all_of(names->begin(), names->end(),
                        [&](const RescopedName& name) { return own_names_.is_one_thing(name, now, side); }))
            weaken(pair, finding, Level::Note, "it only writes names with their scope, or without it");
        return;  // a name of something else
    }
    if (only_respells_members(texts.before, texts.now))
        return weaken(pair, finding, Level::Note, "it only reaches members through a pointer, or no longer does");
    if (const std::string swept = swept_names_.say(side, texts.before, texts.now); !swept.empty())
        return weaken(pair, finding, Level::Note, swept);
    finding.causes = swept_names_.causes(side, now.file, texts.before, texts.now);
    if (structs) {
        if (const auto base = only_changes_base(texts.before, texts.now); !base.empty() && !own_names_.of(side, base))
            return weaken(pair, finding, Level::Note, "it only derives from what is not of the project, or no longer");
        if (only_changes_fields_of_its_own(texts))
            weaken(pair, finding, Level::Note, "the two structs never had most of their fields in common");
        else if (!is_likely_owed(laid))
            doubt(pair, finding, "little of what it touches has its like on the other side");
        return;
    }
    if (only_follows_runtime(texts.before, texts.now))
        return weaken(pair, finding, Level::Note, "it only calls a runtime as its later, or earlier, version wants");
    if (const auto calls = only_respelled_calls(texts.before, texts.now);
        calls && call_the_same(*calls, side, texts.other))
        return weaken(pair, finding, Level::Note, "it only calls the same by another spelling");
    if (without_asides(texts.before) == without_asides(texts.now))
        return weaken(pair, finding,
                      is_of_few_words(texts.before, texts.now) && !only_rewords_texts(texts.before, texts.now)
                          ? Level::Warning
                          : Level::Note,
                      "it only changes what is printed, checked or timed");
    const Language language = language_of_path(now.file);
    const bool names_parts = only_names_parts(texts.before, texts.now, now.kind, language, dialect_);
    if ((names_parts || computes_as_before(before.words(), now.text.words(), dialect_, language)) &&
        !are_twins(texts.before, texts.other, dialect_))
        return weaken(pair, finding, Level::Note,
                      names_parts ? "it only names a part, or writes it out"
                                  : "it computes what it computed before, in other statements");
    if (only_concerns_unread_locals(texts.before, texts.now, dialect_) &&
        !own_names_.are_locals_in_macros(texts.before, side) && !own_names_.are_locals_in_macros(texts.now, side))
        return weaken(pair, finding, Level::Note, "it only brings or takes names that nothing reads");
    if (only_concerns_unread_parameters(texts.before, texts.now) && !are_twins(texts.before, texts.other, dialect_))
        return weaken(pair, finding, Level::Note, "it only brings or takes parameters that it never reads");
    // What the port holds before it is given anything is its own matter; the source may have mended a fault of both.
    const bool is_own_matter = !is_contract(facts_.map.reference, side);
    if (is_own_matter && only_gives_first_values(texts.before, texts.now))
        return weaken(pair, finding, Level::Note, "it only gives first values to names that had none");
    const std::string there_is = side == Side::Source ? "the port" : "the source";
    if (is_own_matter && only_waits_more(texts.before, texts.now))
        return weaken(pair, finding, Level::Note, "it only waits more often for its own device");
    if (only_tends_foreign_runtime(texts.before, texts.now, texts.other))
        return weaken(pair, finding, Level::Note,
                      "it only keeps house with a runtime that " + there_is + " does not call");
    if (is_own_matter && only_concerns_own_runtime(laid))
        return weaken(pair, finding, Level::Note,
                      "it only changes how it drives a runtime that the source does not call");
    if (only_adds_labels_of_other(texts.before, texts.now, texts.other))
        return weaken(pair, finding, Level::Note, there_is + " has the label in that arm already");
    if (adds_labels_to_other_arms(texts.before, texts.now, texts.other)) return;
    if (const auto arms = arms_of_other(texts, dialect_); arms != ArmsOfOther::None) {
        if (arms != ArmsOfOther::Others)
            weaken(pair, finding, arms == ArmsOfOther::Same ? Level::Note : Level::Warning,
                   there_is + " has an arm for each of these labels");
        return;
    }
    if (const std::string beside = same_edit_beside(facts_, watched_, pair, side, before, dialect_); !beside.empty())
        return weaken(pair, finding, Level::Note, "the same edit came to " + beside + ", which no pair watches");
    if (const Nearing nearing = draws_nearer(laid); nearing != Nearing::No) {
        const bool in_order = nearing == Nearing::Yes;
        // What is gone draws any two texts nearer that the other says in words of its own.
        const bool is_slip = only_takes(texts.before, texts.now) && (words_edited(texts.before, texts.now) < kNoSlip ||
                                                                     !are_twins(texts.now, texts.other, dialect_));
        return weaken(
            pair, finding, in_order && !is_slip ? Level::Note : Level::Warning,
            there_is + (in_order                               ? " has most of it"
                        : nearing == Nearing::WithOtherMembers ? " has most of it, with another member or function"
                                                               : " has its words, some in other places"));
    }
    weigh_ground(pair, side, laid, finding);
}

/// What an edit has to do with the other side's text, where nothing else tells. What that has nothing like may be a
/// feature that it is owed as well as a matter of this side's own: it is in doubt, and a note only where a runtime is
/// kept house with.
void PairJudge::weigh_ground(JudgedPair& pair, Side side, LaidEdit& laid, Finding& finding) const {
    const std::string there = side == Side::Source ? "the port" : "the source";
    const OffGround off = off_common_ground(laid);
    if (off == OffGround::No) {
        if (!is_likely_owed(laid)) doubt(pair, finding, "little of what it touches has its like in " + there);
        return;
    }
    const bool is_upkeep = off >= OffGround::Perhaps && only_tends_runtime(laid.texts().before, laid.texts().now);
    pair.is_of_own_part = is_upkeep || off == OffGround::Surely ||
                          (off == OffGround::Perhaps && !is_contract(facts_.map.reference, side));
    if (is_upkeep)
        weaken(pair, finding, Level::Note,
               "it only keeps house with its runtime, where " + there + " has nothing like it");
    else
        doubt(pair, finding, there + " has nothing like what it changes");
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
    if (finding.level > Level::Note && !found.displaced) weigh_edits(pair, before, finding);
}

/// True if the branches for the compiler that only one side has may be under a wrong switch: one that nothing else of
/// that side asks for, or another than what they use stands under.
bool PairJudge::has_doubtful_switch(const PairTexts& texts, const JudgedPair& pair) const {
    for (const Side side : kBothSides) {
        if (own_switches_disagree(texts, side)) return true;
        for (const std::string_view macro : lone_own_switches(texts, side)) {
            const auto& units = facts_.units(side);
            const bool is_known = std::any_of(units.begin(), units.end(), [&](const auto& one) {
                if (&one.second == pair.unit[side]) return false;
                const Words words = one.second.text.words();
                return std::find(words.begin(), words.end(), macro) != words.end();
            });
            if (!is_known) return true;
        }
    }
    return false;
}

/// Edits of both sides of a function that seem to be one are a note. Beside the text, how the files declare what it
/// uses may have changed.
void PairJudge::weigh_edits(const JudgedPair& pair, const BySide<NormalText>& before, Finding& finding) const {
    BySide<Words> then, now;
    bool is_declared_alike = true;
    for (const Side side : kBothSides) {
        const UnitState& unit = *pair.unit[side];
        if (unit.kind != UnitKind::Function && unit.kind != UnitKind::Kernel) return;
        const Words old_text = before[side].words(), new_text = unit.text.words();
        if (prelude_of(old_text) != prelude_of(new_text)) is_declared_alike = false;
        then[side] = without_prelude(old_text);
        now[side] = without_prelude(new_text);
    }
    const PairTexts texts{then.source, now.source, then.target, now.target};
    if (is_declared_alike && without_asides(then.source) == without_asides(now.source) &&
        without_asides(then.target) == without_asides(now.target))
        return weaken(pair, finding, Level::Note, "both only change what is printed, checked or timed");
    const auto language = [&](Side side) { return language_of_path(pair.unit[side]->file); };
    const BySide<Language> languages{language(Side::Source), language(Side::Target)};
    const LearnedWords said = in_words_of_target(texts, dialect_, {pair.id.source, pair.id.target});
    const PairTexts learned{said.before, said.now, texts.target_before, texts.target_now};
    const auto weigh = [&](Level level, const std::string& why) {
        if (is_declared_otherwise(texts))
            weaken(pair, finding, Level::Warning, why + ", beside a type or a pragma that one side changed");
        else
            weaken(pair, finding, level, why);
    };
    if (!swept_names_.say(Side::Source, then.source, now.source).empty() &&
        !swept_names_.say(Side::Target, then.target, now.target).empty())
        weigh(Level::Note, "both only give things new names, as all of both sides does");
    else if (is_declared_alike && swept_names_.are_same_on_both(texts))
        weigh(Level::Note, "both only give the same things the same new names");
    else if (only_adds_labels_of_other(then.source, now.source, now.target) &&
             only_adds_labels_of_other(then.target, now.target, now.source))
        weigh(Level::Note, "the same labels joined an arm on both sides");
    else if (is_declared_alike && (edits_spot_by_spot(texts, dialect_) || edits_spot_by_spot(learned, dialect_)))
        weigh(Level::Note, "word for word the same came and went, at the same places");
    else if (is_declared_alike && compute_alike_now(texts, dialect_, languages))
        weigh(Level::Note, "both compute the same now");
    else if (is_declared_alike &&
             (differ_in_rounding(texts, dialect_, languages) || differ_in_rounding(learned, dialect_, languages)))
        weigh(Level::Note, "one side computes in several steps what the other computes in one");
    else if (is_declared_alike && finding.details.size() <= kMostChosen &&
             (choose_alike(texts, dialect_, languages) || choose_alike(learned, dialect_, languages)))
        weigh(Level::Note, "one side chooses or computes in another way what the other does");
    else if (is_declared_alike && retype_alike(texts))
        weigh(Level::Note, "both only give the same things another type, the same one");
    else if (const auto bare = without_own_switches(texts);
             bare && are_one_without_switches(*bare, dialect_, languages))
        weigh(has_doubtful_switch(texts, pair) ? Level::Warning : Level::Note,
              "each side says what the other does, one of them within branches for the compiler");
    else if (edits_in_own_words(texts, dialect_))
        weigh(grouping_of_edits(texts, dialect_) == Grouping::Alike && !edits_contradict(learned, dialect_) &&
                      !bring_other_members(texts, dialect_)
                  ? Level::Note
                  : Level::Warning,
              "each side says for the most part what the other does");
    else if (is_declared_alike && (edits_leave_no_difference(texts, dialect_, languages) ||
                                   edits_leave_no_difference(learned, dialect_, languages)))
        weigh(Level::Note, "what came is the same, and what each had in its own words is gone");
    else if (bring_the_same_names(texts))
        weigh(Level::Note, "both bring the same names, each in the way of its runtime");
    else if (drives_device(then.source) && drives_device(then.target) &&
             words_edited(then.source, now.source) >= kNoSlip && words_edited(then.target, now.target) >= kNoSlip)
        weigh(Level::Warning, "both allocate, copy or launch, each in its own way");
}

}  // namespace porttool
