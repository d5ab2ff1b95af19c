// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// accept, defer and ignore: what a person does with a finding.
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include "porttool/command/commands.h"
#include "porttool/command/named.h"
#include "porttool/judge/brought_in.h"
#include "porttool/judge/lock_index.h"
#include "porttool/judge/macro_record.h"
#include "porttool/judge/settle.h"
#include "porttool/read/clock.h"
#include "porttool/read/git_repository.h"
#include "porttool/snapshot/lock_store.h"
#include "porttool/snapshot/map_edit.h"
#include "porttool/snapshot/map_merge.h"
#include "porttool/text/date.h"
#include "porttool/text/sink/shell.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// The unit of a finding outside pairs; findings of other rules than those on it cannot be settled.
const UnitState& lone_unit(const CheckedProject& checked, const Finding& finding) {
    const auto unit = checked.states[finding.side].find(finding.map_source);
    const bool of_unit = is_of_new_unit(finding) || finding.rule == Rule::DeferralExpired;
    if (!of_unit || unit == checked.states[finding.side].end())
        throw CannotDo(fmt::format("{}: a finding of '{}' cannot be settled; {}", finding.fingerprint,
                                   rule_name(finding.rule), terminal_text(finding.remedy)));
    return unit->second;
}

/// Writes the lock without what holds for nothing any more, and the map where it was changed. What the project was
/// warned of is told, and what could not be written anew of the texts behind the lock.
void store(CheckedProject& checked, Workplace& place, const std::string& warnings,
           const std::string* map_text = nullptr) {
    place.err << warnings;
    drop_idle_lines(checked.lock, checked.project.map, checked.states.source, checked.states.target,
                    checked.project.skipped);
    const bool clears = checked.lock.version == 1;  // its texts have other names
    store_lock(checked.project, {checked.lock, checked.states, checked.texts, map_text, clears}, place.disk);
    place.err << told(lost_texts(checked.project, place.disk, checked.lock));
}

/// Reads and judges the project. What it warns of is for the end: an error has two lines at most, and nothing before
/// it.
CheckedProject judged_project(const Options& options, Workplace& place, std::string& warnings) {
    std::ostringstream err;
    Workplace quiet{place.disk, err};
    CheckedProject checked = check_project(options, quiet);
    warnings = err.str();
    return checked;
}

/// Throws CannotDo for an option of words that has none.
void require_words(const char* option, const std::string& given, const char* what) {
    if (given.find_first_not_of(" \t\n") == std::string::npos)
        throw CannotDo(std::string(option) + " is empty; say " + what);
}

Outcome settle(const Options& options, Workplace& place, Verdict verdict) {
    require_format(options.format, {"text"});
    require_words("--reason", options.reason, "why, for those who read it next year");
    if (verdict == Verdict::Defer) require_words("--owner", options.owner, "who will do it");
    const auto guard = guard_lock(options, place);
    std::string warnings;
    CheckedProject checked = judged_project(options, place, warnings);
    follow_baseline(checked.lock, checked.judgement);
    LedgerEntry said;
    said.verdict = verdict;
    said.owner = options.owner;
    said.until = options.until;
    said.reason = options.reason;
    const char* done = verdict == Verdict::Defer ? "deferred" : "ignored";
    std::string out;
    for (const std::string& id : options.paths) {
        const LoneUnit* lone = find_lone(checked.judgement, id);
        const Named named = lone != nullptr ? Named() : require_named(checked.judgement, id);
        if (named.pairs.empty()) {
            const Side side = lone != nullptr ? lone->side : named.lone.front()->side;
            const UnitState& unit = lone != nullptr ? *lone->unit : lone_unit(checked, *named.lone.front());
            settle_lone(checked.lock, unit, side, said);
            out += fmt::format("{} {}\n", done, terminal_text(unit.id));
        }
        for (const JudgedPair* pair : named.pairs) {
            settle_pair(checked.lock, *pair, said);
            out += fmt::format("{} {} = {}\n", done, terminal_text(pair->id.source), terminal_text(pair->id.target));
        }
    }
    store(checked, place, warnings);
    return {out, 0, false, kLockIsWritten};
}

/// SOURCE=TARGET of two units that are there. An id may hold equal signs itself.
std::optional<JudgedPair> units_named(const CheckedProject& checked, const std::string& id) {
    for (size_t cut = id.find('='); cut != std::string::npos; cut = id.find('=', cut + 1)) {
        const auto source = checked.states.source.find(id.substr(0, cut));
        const auto target = checked.states.target.find(id.substr(cut + 1));
        if (source != checked.states.source.end() && target != checked.states.target.end())
            return JudgedPair{{source->first, target->first}, {&source->second, &target->second}};
    }
    return std::nullopt;
}

/// Of SOURCE=TARGET the side that is no unit, where the other is one: what to say of it; "" if neither is.
std::string half_named(const CheckedProject& checked, const std::string& id) {
    for (size_t cut = id.find('='); cut != std::string::npos; cut = id.find('=', cut + 1)) {
        const std::string source = id.substr(0, cut), target = id.substr(cut + 1);
        const bool is_source = checked.states.source.contains(source),
                   is_target = checked.states.target.contains(target);
        if (is_source == is_target) continue;
        const std::string& lost = is_source ? target : source;
        return "no such pair: " + terminal_text(lost) + ": no such unit on the " + (is_source ? "target" : "source") +
               " side; list those of its file with: porttool scan " + terminal_text(lost.substr(0, lost.find(':')));
    }
    return "";
}

/// The pair that a finding of `unpaired` suggests.
std::optional<JudgedPair> pair_suggested(const CheckedProject& checked, const Named& named, const std::string& id) {
    if (named.lone.empty() || named.lone.front()->rule != Rule::Unpaired || named.lone.front()->fingerprint != id)
        return std::nullopt;
    return units_named(checked, named.lone.front()->source->id + "=" + named.lone.front()->target->id);
}

/// What accept was asked for.
struct Acceptance {
    std::vector<const JudgedPair*> pairs;  ///< each once
    std::deque<JudgedPair> fresh;          ///< those of them that no map names yet
};

/// Throws CannotDo for a pair of which a unit is not there: it can be in step with nothing.
void require_both_there(const CheckedProject& checked, const JudgedPair& pair) {
    if (pair.unit.source != nullptr && pair.unit.target != nullptr) return;
    const std::string& lost = pair.unit.source == nullptr ? pair.id.source : pair.id.target;
    const auto& findings = checked.judgement.findings;
    const auto told = std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return is_of(f, pair); });
    throw CannotDo(terminal_text(pair.id.source + "=" + pair.id.target) + ": " + terminal_text(lost) +
                   " is not there, or not read; nothing was recorded" +
                   (told == findings.end() ? "" : "\n" + terminal_text(told->remedy)));
}

/// Finds the pairs that the ids name. Throws CannotDo for one that names none, or one that is not there.
void find_accepted(const CheckedProject& checked, const std::vector<std::string>& ids, Acceptance& out) {
    std::set<std::pair<std::string, std::string>> fresh;
    for (const std::string& id : ids) {
        const Named named = named_by(checked.judgement, id);
        for (const JudgedPair* pair : named.pairs) require_both_there(checked, *pair);
        out.pairs.insert(out.pairs.end(), named.pairs.begin(), named.pairs.end());
        if (!named.pairs.empty()) continue;
        std::optional<JudgedPair> pair = units_named(checked, id);
        if (!pair) pair = pair_suggested(checked, named, id);
        if (!pair) {
            if (const std::string half = named.lone.empty() ? half_named(checked, id) : ""; !half.empty())
                throw CannotDo(half);
            const Named other = require_named(checked.judgement, id);
            throw CannotDo(terminal_text(id) + ": there is no pair to accept; " +
                           terminal_text(other.lone.front()->remedy));
        }
        if (!fresh.insert({pair->id.source, pair->id.target}).second) continue;
        out.fresh.push_back(*std::move(pair));
        out.pairs.push_back(&out.fresh.back());
    }
    std::sort(out.pairs.begin(), out.pairs.end());
    out.pairs.erase(std::unique(out.pairs.begin(), out.pairs.end()), out.pairs.end());
}

}  // namespace

void declare_accept(Declare& declare, Options& options) {
    declare.texts("id", options.paths, "ID", "Ids, SOURCE=TARGET, or fingerprints of findings");
    declare.flag("--all", options.all, "Every pair whose two edits are equivalent");
    declare.flag("--force", options.force, "With --all: every pair");
    declare.flag("--merge", options.merge, "Keep the pairs of both sides where portmap.toml is in conflict");
    declare.text("--reason", options.reason, "TEXT", "Why");
}

namespace {

/// The pairs of the map that the two sides of a merge come from; none where git knows of no merge over it.
std::vector<NewPair> pairs_before_merge(const Project& project) {
    const std::string file = map_behind_links(project);
    const GitRepository git(project.root);
    const auto text = git.error().empty() ? git.ancestor_in_merge(file) : std::nullopt;
    std::vector<NewPair> out;
    if (!text) return out;
    for (const MapPair& pair : read_map(file, *text).map.pairs)
        for (const std::string& target : pair.targets) out.push_back({pair.source, target});
    return out;
}

/// Writes the map of a merge that git could not finish with the pairs of both its sides.
Outcome merge_map(const Options& options, Workplace& place) {
    if (options.all || !options.paths.empty())
        throw CannotDo("accept --merge takes no ids and no --all; run it first, and accept then");
    const auto guard = guard_lock(options, place);
    Project project;
    find_map(project, options, place.disk);
    const FileText file = read_map_text(place.disk, project.root, project.map_path);
    if (!file.error.empty()) throw CannotDo(terminal_text(project.map_path) + ": " + file.error);
    const MapSides sides = map_sides(project.map_name, file.bytes);
    const std::vector<NewPair> before = pairs_before_merge(project);
    const MergedMap merged = merged_map(project, sides.ours, sides.theirs, before);
    const MergedMap other = merged_map(project, sides.theirs, sides.ours, before);
    const LockFile no_lock;
    const std::vector<PlacedSuppression> no_comments;
    const std::vector<BroughtIn> differs = brought_in({true, merged.map, false, no_lock, no_comments},
                                                      {true, other.map, false, no_lock, no_comments}, project.map_name);
    if (!differs.empty())
        throw CannotDo(terminal_text(project.map_name) + ": the two sides differ in more than pairs (" +
                       terminal_text(differs.front().text) + "); nothing was written\nMerge it by hand");
    const std::string name = project.map_path.substr(project.map_path.find_last_of('/') + 1);
    if (const std::string failure = place.disk.write(beside_map(project, name), merged.text); !failure.empty())
        throw CannotDo(failure);
    std::string out = terminal_text(project.map_name) + ": the pairs of both sides are kept; of theirs came in:\n";
    for (const NewPair& pair : merged.added)
        out += "  " + terminal_text(pair.source) + " = " + terminal_text(pair.target) + "\n";
    if (!merged.removed.empty()) out += "and what one side had taken out stays out:\n";
    for (const NewPair& pair : merged.removed)
        out += "  " + terminal_text(pair.source) + " = " + terminal_text(pair.target) + "\n";
    return {out + "Go on with: git add " + terminal_text(shell_word(map_behind_links(project))) + "\n", 0, false, ""};
}

}  // namespace

Outcome run_accept(const Options& options, Workplace& place) {
    require_format(options.format, {"text"});
    if (options.merge) return merge_map(options, place);
    if (!options.all && options.paths.empty())
        throw CannotDo("accept needs ids, or --all for every pair whose two edits are equivalent");
    if (options.all && !options.paths.empty())
        throw CannotDo("accept takes ids or --all, not both: leave out --all to accept " +
                       terminal_text(options.paths.front()) + (options.paths.size() > 1 ? " and the others" : "") +
                       " alone");
    const auto guard = guard_lock(options, place);
    std::string warnings;
    CheckedProject checked = judged_project(options, place, warnings);
    follow_baseline(checked.lock, checked.judgement);
    Acceptance acceptance;
    find_accepted(checked, options.paths, acceptance);
    std::vector<const JudgedPair*> accepted = std::move(acceptance.pairs), left;
    if (options.all) {
        ChangedPairs changed = changed_pairs(checked.judgement);
        accepted = std::move(changed.alike);
        left = std::move(changed.different);
        if (options.force) {
            accepted.insert(accepted.end(), left.begin(), left.end());
            accepted.insert(accepted.end(), changed.under_macros.begin(), changed.under_macros.end());
            left.clear();
            accept_unwatched(checked.lock, checked.judgement, checked.states, options.reason);
        }
    }
    accept_pairs(checked.lock, accepted, TargetSets(checked.project.map), options.all ? Looked::AtNone : Looked::AtEach,
                 options.reason, today());
    note_macros(checked.lock, checked.judgement, accepted, checked.files(), checked.states);
    // Lines from before macros were noted; one that is named takes no other lines along.
    const size_t noted = options.all ? note_macros(checked.lock, checked.files(), checked.states) : 0;
    std::vector<NewPair> fresh;
    for (const JudgedPair& pair : acceptance.fresh) fresh.push_back({pair.id.source, pair.id.target});
    const std::string map = fresh.empty() ? std::string() : add_pairs(checked.project, fresh);
    store(checked, place, warnings, fresh.empty() ? nullptr : &map);
    std::string out = fmt::format("{} pairs recorded as in step\n", accepted.size());
    if (!fresh.empty()) out += fmt::format("{} of them written into portmap.toml\n", fresh.size());
    if (noted > 0) out += fmt::format("{} more lines note what macros make of their words\n", noted);
    if (checked.lock.version == 1)
        out += "portmap.lock is rewritten as version 2: this once, all of its lines change\n";
    if (!left.empty())
        out += fmt::format(
            "{} changed pairs left: new to the lock, or their edits are not equivalent; name them, or "
            "add --force:\n",
            left.size());
    for (const JudgedPair* pair : left) out += "  " + terminal_line(pair->id.source) + "\n";
    return {out, left.empty() ? 0 : 1, false, kLockIsWritten};
}

Outcome run_reject(const Options& options, Workplace& place) {
    const auto guard = guard_lock(options, place);
    std::string warnings;
    CheckedProject checked = judged_project(options, place, warnings);
    follow_baseline(checked.lock, checked.judgement);
    const BySide<std::string> id{options.paths.at(0), options.paths.at(1)};
    const auto pair = std::find_if(checked.judgement.pairs.begin(), checked.judgement.pairs.end(),
                                   [&](const JudgedPair& one) { return one.id == id; });
    if (pair == checked.judgement.pairs.end())
        throw CannotDo(terminal_text(id.source + "=" + id.target) + ": no such pair");
    const std::string map = remove_pair(checked.project, {id.source, id.target});
    reject_pair(checked.lock, *pair, checked.project.map);
    store(checked, place, warnings, &map);
    return {"no longer a pair: " + terminal_text(id.source) + " = " + terminal_text(id.target) + "\n", 0, false,
            kLockIsWritten};
}

void declare_defer(Declare& declare, Options& options) {
    declare.texts("id", options.paths, "ID", "Id, SOURCE=TARGET, or fingerprint").required();
    declare.text("--owner", options.owner, "NAME", "Who will port it").required();
    declare.text("--until", options.until, "DATE", "YYYY-MM-DD").required();
    declare.text("--reason", options.reason, "TEXT", "Why not now").required();
}

Outcome run_defer(const Options& options, Workplace& place) {
    if (!is_date(options.until))
        throw CannotDo("--until " + terminal_text(options.until) + ": expected a date as YYYY-MM-DD");
    if (options.until < today())
        throw CannotDo("--until " + terminal_text(options.until) + " is past: today is " + today() +
                       "; give the last day to wait");
    return settle(options, place, Verdict::Defer);
}

void declare_ignore(Declare& declare, Options& options) {
    declare.texts("id", options.paths, "ID", "Id, SOURCE=TARGET, or fingerprint").required();
    declare.text("--reason", options.reason, "TEXT", "Why").required();
}

Outcome run_ignore(const Options& options, Workplace& place) { return settle(options, place, Verdict::Ignore); }

}  // namespace porttool
