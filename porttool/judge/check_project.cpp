// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/check_project.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "porttool/judge/base_lock.h"
#include "porttool/judge/brought_in.h"
#include "porttool/judge/evidence.h"
#include "porttool/read/clock.h"
#include "porttool/read/git_repository.h"
#include "porttool/read/lock_upgrade.h"
#include "porttool/read/source_glob.h"
#include "porttool/scan/scan.h"
#include "porttool/snapshot/folder_of_base.h"
#include "porttool/snapshot/lock_store.h"
#include "porttool/text/sink/shell.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// The comments of both sides that settle findings.
std::vector<PlacedSuppression> placed_suppressions(const Snapshot& snapshot) {
    std::vector<PlacedSuppression> suppressions;
    for (const Side side : kBothSides) {
        const FilesOfSide files = snapshot.files(side);
        for (size_t i = 0; i < files.size(); ++i)
            for (const Suppression& comment : files.suppressions(i)) {
                const std::string& path = files.path(i);
                suppressions.push_back(
                    {side == Side::Source ? path : target_path(snapshot.project.map, path), comment});
            }
    }
    return suppressions;
}

/// Puts the map that is staged, if there is one, in the place of today's.
void take_staged_map(Project& project, Workplace& place) {
    const FileText text = map_text_at(project, {Moment::Kind::Index}, place.disk);
    if (!text.error.empty()) return;
    use_map(project, "portmap.toml (staged)", text.bytes);
    require_sides_beneath(project, place.disk);
}

/// Puts the map of the merge base in the place of today's.
void take_map_of_base(Project& project, const std::string& revision, Workplace& place) {
    const std::string path = map_in_commits(project);
    if (path.empty()) return;
    const FileText text = map_text_at(project, {Moment::Kind::MergeBase, revision}, place.disk);
    if (!text.error.empty())
        throw CannotDo("--trusted-map: there is no " + terminal_text(path) + " at the merge base of " +
                       terminal_text(revision) +
                       "\nMerge a first map into that branch; until then check without --trusted-map");
    use_map(project, path + " at " + revision, text.bytes);
    require_sides_beneath(project, place.disk);
}

/// With --base the lock only adds what was accepted since: one that cannot be read is left out.
RecordedLock lock_if_readable(const CheckedProject& checked, std::ostream& err) {
    if (!checked.recorded) return {};
    try {
        return load_lock(checked.project, checked.disk(), checked.states);
    } catch (const CannotDo& problem) {
        err << "warning: " << problem.what() << "\nWithout it, what was accepted since the base is not known\n";
        return {};
    }
}

bool has_same_sides(const MapFile& a, const MapFile& b) {
    return a.source == b.source && a.target == b.target && a.target_root == b.target_root;
}

/// True for the texts of a lock of an older normal form: they are in memory.
bool is_upgraded(const std::map<Print, UnitText>& texts) { return !texts.empty(); }

/// Tells the texts that the lock of a change needs and cannot use, and lists those that its merge base still had.
void tell_lost_texts(const CheckedProject& checked, const RecordedLock& now, Snapshot& base, Workplace& place,
                     std::vector<BroughtIn>& brought) {
    if (now.lock.version == 1 || is_upgraded(now.texts)) return;
    const LostTexts lost = lost_texts(checked.project, checked.disk(), now.lock);
    place.err << told(lost);
    if (lost.missing.empty() && lost.damaged.empty()) return;
    read_base_texts(base);
    for (const LockedPair& pair : now.lock.pairs)
        for (const auto& [id, print] : {std::pair(&pair.source, pair.source_prints.written),
                                        std::pair(&pair.target, pair.target_prints.written)}) {
            const bool is_damaged = lost.damaged.contains(print);
            if ((is_damaged || lost.missing.contains(print)) && !base_text(base.project, base.git, print).empty())
                brought.push_back({GatePart::Accept, "portmap.lock", std::max(1, pair.line),
                                   "portmap.base/" + print.text() + ", the text of " + *id + " when last in step, " +
                                       (is_damaged ? "is not what its name says" : "is gone")});
        }
}

/// Takes the state at the merge base for what was in step. Returns what the change itself does to the gate.
std::vector<BroughtIn> hold_against_base(CheckedProject& checked, const CheckChoice& choice, const MapFile& map_today,
                                         Workplace& place, FactsStore* kept) {
    const auto see_files = [&](const Snapshot& then) {
        for (const Side side : kBothSides) checked.new_words[side] = new_words(checked.files(side), then.files(side));
    };
    Snapshot base = read_snapshot_beside(checked, {Moment::Kind::MergeBase, choice.base}, place.disk, kept, see_files);
    if (!base.note.empty()) place.err << base.note << "\n";
    RecordedLock now = lock_if_readable(checked, place.err);
    const BaseRecord then = base_record(base, now, checked.states, place.err);
    const bool is_readable = !std::exchange(now.written, {}).empty();  // of many units it is large
    const LockFile& then_lock = then.lock(now);
    const LockFile& in_force = choice.trusted_map ? then_lock : now.lock;
    BaseLock in_step = base_lock(base, then_lock, in_force, checked.states, [&](Print print) {
        const auto found = now.texts.find(print);
        return found == now.texts.end() ? base_text(checked.project, checked.disk(), print) : found->second.get();
    });
    const std::vector<PlacedSuppression> known = placed_suppressions(base);
    const GateState before{then.has_map, then.map, then.has_lock, then_lock, known};
    const GateState today{true, map_today, checked.recorded, now.lock, checked.suppressions};
    std::vector<BroughtIn> brought = brought_in(before, today, checked.project.map_name);
    tell_lost_texts(checked, now, base, place, brought);
    if (choice.trusted_map) checked.suppressions = known_before(checked.suppressions, known);
    checked.lock = std::move(in_step.lock);
    checked.texts = std::move(in_step.texts);
    checked.texts.merge(now.texts);
    // What today's globs leave out was not gone then.
    if (!then.has_map || has_same_sides(then.map, checked.project.map))
        checked.gone_before = std::move(in_step.gone_before);
    checked.base_states = std::move(base.states);
    if (choice.trusted_map && then.has_lock)
        checked.in_project = then_lock;
    else if (!choice.trusted_map && checked.recorded && is_readable)
        checked.in_project = std::move(now.lock);
    return brought;
}

/// Judges what was read.
void judge_it(CheckedProject& checked, const std::string& date, const std::vector<SkippedFile>& skipped,
              const SameCode& same_code = {}, const RunEvidence* evidence = nullptr) {
    const auto text_of = [&](Print print) { return text_behind(checked, print); };
    Case facts{checked.project.map,  checked.lock, checked.states.source, checked.states.target, skipped, text_of, date,
               checked.suppressions, same_code};
    facts.evidence = evidence;
    facts.gone_before = &checked.gone_before;
    const bool against_base = checked.against_base;
    if (against_base) {
        facts.at_base = {&checked.base_states.source, &checked.base_states.target};
        facts.new_words = &checked.new_words;
    }
    if (checked.in_project)
        facts.in_project = &*checked.in_project;
    else if (checked.recorded && !against_base)
        facts.in_project = &checked.lock;
    if (checked.recorded || against_base) facts.files = checked.files();
    checked.judgement = judge(facts);
}

/// Judges once more, now knowing what programs saw that no finding explains.
void judge_with_evidence(CheckedProject& checked, const std::vector<std::string>& paths, const SameCode& same_code,
                         Workplace& place) {
    const std::vector<EvidenceFile> files = evidence_of(paths, checked.project, place.disk);
    const EvidenceJoin evidence(files, checked.states);
    const RunEvidence seen = evidence.unexplained(checked.judgement);
    judge_it(checked, today(), checked.project.skipped, same_code, &seen);
    evidence.join(checked.judgement);
    if (const size_t count = evidence.strangers(checked.judgement); count > 0)
        place.err << "note: " << count << " pairs of the evidence are not in " << checked.project.map_name << "\n";
}

/// The texts that a sparse checkout leaves out, as the index has them; none for one that is not what its name says.
std::map<Print, UnitText> left_out_texts(const Project& project, const LostTexts& lost) {
    std::map<Print, UnitText> out;
    if (lost.left_out.empty()) return out;
    const std::string before = lost.folder + "/";
    const auto print_of = [&](const std::string& path) {
        return path.starts_with(before) ? Print::read(path.substr(before.size())) : Print();
    };
    const auto wants = [&](const std::string& path) { return lost.left_out.contains(print_of(path)); };
    GitFiles files = GitRepository(project.root).files_in_index(wants, {lost.folder});
    for (auto& [path, bytes] : files.files) {
        std::erase(bytes, '\r');
        NormalText text = text_of_print(print_of(path), bytes, kNormalForm);
        if (!text.empty()) out.emplace(print_of(path), std::move(text));
    }
    return out;
}

/// Without them the gate still tells that a text was edited, not how, and takes no two edits for the same.
void note_missing_texts(CheckedProject& checked, Workplace& place) {
    if (checked.lock.version == 1 || is_upgraded(checked.texts)) return;
    const LostTexts lost = missing_texts(checked.project, checked.disk(), checked.lock);
    place.err << told(lost);
    checked.texts.merge(left_out_texts(checked.project, lost));
}

/// Files of the sides that a sparse checkout leaves out look as if somebody had removed them.
void note_left_out(const CheckedProject& checked, Workplace& place) {
    const auto& pairs = checked.judgement.pairs;
    const bool is_whole = std::all_of(pairs.begin(), pairs.end(), [](const JudgedPair& pair) {
        return pair.unit.source != nullptr && pair.unit.target != nullptr;
    });
    if (is_whole) return;
    const Project& project = checked.project;
    SideGlobs sides(project.map.source);
    if (project.map.target_root.empty()) sides.add(project.map.target);
    std::vector<std::string> out;
    for (const std::string& file : GitRepository(project.root).left_out_of(""))
        if (sides.takes(file) && !place.disk.exists(join_path(project.root, file))) out.push_back(file);
    if (out.empty()) return;
    place.err << "warning: " << out.size() << " files of the sides (the first is " << terminal_text(out.front())
              << ") are not here, as this is a sparse checkout, and count as gone; to have them, run: "
                 "git sparse-checkout add "
              << terminal_text(shell_word(out.front().substr(0, out.front().find('/')))) << "\n";
}

/// A unit that was followed to where its text stands now is watched there, and no longer where it was.
void list_moved(const Judgement& judgement, std::vector<BroughtIn>& out) {
    for (const JudgedPair& pair : judgement.pairs)
        for (const Side side : kBothSides) {
            const UnitState* unit = pair.unit[side];
            if (unit != nullptr && unit->id != pair.id[side] && unit->file != split_id(pair.id[side]).first)
                out.push_back({GatePart::Pair, unit->file, static_cast<int>(unit->start_line),
                               pair.id[side] + " is followed to " + unit->id});
        }
}

/// What is to be judged.
Snapshot read_now(Project project, const CheckChoice& choice, Workplace& place, CheckedProject* last,
                  FactsStore* kept) {
    if (last != nullptr && !choice.staged) return read_snapshot_again(std::move(project), std::move(*last), place.disk);
    const Moment at{choice.staged ? Moment::Kind::Index : Moment::Kind::WorkTree};
    if (kept != nullptr) return read_snapshot(std::move(project), at, place.disk, *kept);
    return read_snapshot(std::move(project), at, place.disk);
}

}  // namespace

NormalText text_behind(const CheckedProject& checked, Print print) {
    const auto found = checked.texts.find(print);
    return found == checked.texts.end() ? base_text(checked.project, checked.disk(), print) : found->second.get();
}

CheckedProject check_project(const CheckChoice& choice, Workplace& place, const SameCodeIn& same_code_in,
                             CheckedProject* last, FactsStore* kept) {
    if (choice.trusted_map && choice.base.empty())
        throw CannotDo("--trusted-map takes map and lock from the merge base; name it with --base REV");
    Project project = open_project(choice, place, true);
    if (choice.staged) take_staged_map(project, place);
    if (!choice.base.empty()) require_folder_of_base(project, choice, choice.base, place.disk);
    // A map can have half a million pairs: a second one is there only where they differ.
    const std::optional<MapFile> map_today = choice.trusted_map ? std::optional(project.map) : std::nullopt;
    if (choice.trusted_map) take_map_of_base(project, choice.base, place);
    CheckedProject checked{read_now(std::move(project), choice, place, last, kept)};
    checked.recorded = checked.disk().exists(lock_path(checked.project));
    checked.suppressions = placed_suppressions(checked);
    std::vector<BroughtIn> brought;
    checked.against_base = !choice.base.empty();
    if (checked.against_base) {
        brought = hold_against_base(checked, choice, map_today ? *map_today : checked.project.map, place, kept);
    } else if (checked.recorded || !choice.lock_is_optional) {
        RecordedLock recorded = load_lock(checked.project, checked.disk(), checked.states);
        checked.lock = std::move(recorded.lock);
        checked.texts = std::move(recorded.texts);
        note_missing_texts(checked, place);
    }
    const SameCode same_code = same_code_in ? same_code_in(checked) : SameCode();
    judge_it(checked, today(), checked.project.skipped, same_code);
    if (!choice.run_evidence.empty()) judge_with_evidence(checked, choice.run_evidence, same_code, place);
    if (!choice.staged) note_left_out(checked, place);
    if (!choice.base.empty()) list_moved(checked.judgement, brought);
    if (choice.base.empty() && !checked.recorded) checked.judgement.findings.clear();
    checked.judgement.brought_in = std::move(brought);
    checked.base_states = {};  // what was asked for only while it was judged, and is as large as the project
    checked.new_words = {};
    return checked;
}

CheckedProject past_project(const Project& today, const std::string& revision, const Disk& on_disk) {
    if (!today.map.target_root.empty())
        throw CannotDo("--base " + terminal_text(revision) +
                       ": the target side lies in another checkout ([sides] target_root), whose history is not read\n"
                       "Report without --base");
    const Moment then{Moment::Kind::MergeBase, revision};
    Project project = without_files(today);
    if (const FileText text = map_text_at(project, then, on_disk); text.error.empty()) {
        ReadMap read = read_map(project.map_name, text.bytes);
        if (read.error.empty()) {  // else it has an older form: today's pairs are the best guess
            project.map.pairs = std::move(read.map.pairs);
            project.map.ignores = std::move(read.map.ignores);
            project.map.rules = std::move(read.map.rules);
        }
    }
    CheckedProject past{read_snapshot(std::move(project), then, on_disk)};
    past.suppressions = placed_suppressions(past);
    past.recorded = past.git.exists(lock_path(past.project));
    if (past.recorded) {
        read_base_texts(past);
        RecordedLock recorded = load_lock(past.project, past.git, past.states);
        past.lock = std::move(recorded.lock);
        past.texts = std::move(recorded.texts);
    }
    judge_it(past, porttool::today(), {});  // what could not be read then is no finding
    return past;
}

}  // namespace porttool
