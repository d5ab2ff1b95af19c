// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "porttool/command/commands.h"
#include "porttool/compare/paired_names.h"
#include "porttool/judge/assess.h"
#include "porttool/judge/first_record.h"
#include "porttool/judge/macro_record.h"
#include "porttool/match/match_sets.h"
#include "porttool/match/port_sets.h"
#include "porttool/read/clock.h"
#include "porttool/report/map_report.h"
#include "porttool/snapshot/map_edit.h"
#include "porttool/snapshot/merge_marks.h"
#include "porttool/snapshot/snapshot.h"
#include "porttool/snapshot/two_sides.h"
#include "porttool/text/sink/json.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/toml_string.h"

namespace porttool {
namespace {

std::string list(const std::vector<std::string>& texts) {
    std::string out;
    for (const std::string& text : texts) out += (out.empty() ? "" : ", ") + toml_string(text);
    return "[" + out + "]";
}

std::string map_text(const Project& project, const Matching& matching) {
    std::string out =
        "# Which units are ports of which. Written by porttool init; yours to edit.\nversion = 1\n\n[sides]\n";
    out += "source = " + list(project.map.source) + "\n";
    if (project.map.target_sets.empty()) out += "target = " + list(project.map.target) + "\n";
    out += "reference = \"source\"\n";
    if (!project.map.target_sets.empty()) out += "\n[sides.targets]\n";
    for (const TargetSet& set : project.map.target_sets) out += set.name + " = " + list(set.globs) + "\n";
    for (const MatchedPair& pair : matching.pairs) out += pair_text({pair.source, pair.target, pair.score});
    return out;
}

/// The pairs of a first lock, with what their texts say to each other today.
struct AssessedPair {
    std::string source, target;
    Assessment assessment = Assessment::Differs;
};

std::vector<AssessedPair> assess_pairs(const LockFile& lock, const States& states, const Dialect& dialect) {
    CompareBudget budget;
    std::vector<AssessedPair> out;
    for (const LockedPair& pair : lock.pairs)
        out.push_back({pair.source, pair.target,
                       assess(states.source.at(pair.source), states.target.at(pair.target), dialect, budget)});
    return out;
}

/// What says the same is verified by that.
void take_as_verified(LockFile& lock, const std::vector<AssessedPair>& assessed) {
    for (size_t i = 0; i < assessed.size(); ++i)
        if (says_the_same(assessed[i].assessment)) {
            lock.pairs[i].state = kVerified;
            lock.pairs[i].by = "assess " + today();
        }
}

std::string assessed_json(const std::vector<AssessedPair>& assessed) {
    nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
    for (const AssessedPair& pair : assessed)
        pairs.push_back(
            {{"source", pair.source}, {"target", pair.target}, {"assessment", assessment_name(pair.assessment)}});
    const nlohmann::ordered_json out = {{"pairs", pairs}};
    return json_text(out, 1) + "\n";
}

/// Counts, then each pair that does not say the same.
std::string assessed_table(const std::vector<AssessedPair>& assessed) {
    std::array<size_t, kAssessmentNames.size()> counts{};
    std::string list;
    for (const AssessedPair& pair : assessed) {
        ++counts[static_cast<size_t>(pair.assessment)];
        if (!says_the_same(pair.assessment))
            list += fmt::format("  {:<8} {} = {}\n", assessment_name(pair.assessment), terminal_text(pair.source),
                                terminal_text(pair.target));
    }
    std::string out = fmt::format("{} pairs:", assessed.size());
    for (size_t i = 0; i < counts.size(); ++i)
        out += fmt::format("{} {} {}", i == 0 ? "" : ",", counts[i], kAssessmentNames[i]);
    return out + "\n" + list;
}

std::string assessed_text(const std::vector<AssessedPair>& assessed, const Options& options) {
    return options.format == "json" ? assessed_json(assessed) : assessed_table(assessed);
}

/// Says which of the pairs that are now recorded as in step certainly differ.
void tell_differences(const std::vector<std::string>& differences, Workplace& place) {
    constexpr size_t kShown = 20;
    for (size_t i = 0; i < std::min(differences.size(), kShown); ++i)
        place.err << "warning: " << terminal_text(differences[i]) << "\n";
    if (differences.size() > kShown) place.err << "and " << differences.size() - kShown << " more pairs that differ\n";
    if (!differences.empty())
        place.err << "These are recorded as they are, with the reason 'accepted at init'; correct them now if they "
                     "should agree\n";
}

std::string named_ports_line(const std::vector<TargetSet>& sets) {
    std::string names;
    for (const TargetSet& set : sets) names += (names.empty() ? "" : ", ") + terminal_text(set.name);
    return fmt::format("{} ports lie side by side and are named in [sides.targets]: {}\n", sets.size(), names);
}

/// Names the ports that lie side by side in a flat list of targets, where globs tell them apart. True if it did.
bool name_ports(Project& project) {
    project.map.target_sets = port_sets(project.source, project.target, project.map.target);
    return !project.map.target_sets.empty();
}

std::string summary(const Matching& matching, const Project& project, bool named) {
    const auto sure =
        std::count_if(matching.pairs.begin(), matching.pairs.end(), [](const auto& p) { return p.score >= 0.8f; });
    std::string out = fmt::format(
        "{} pairs found, {} of them more than 80 % sure; {} source units have no port, {} target units no source.\n",
        matching.pairs.size(), sure, matching.unmapped_source.size(), matching.unmapped_target.size());
    auto least = matching.pairs;
    std::stable_sort(least.begin(), least.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
    constexpr size_t kShown = 5;
    if (!least.empty() && least.front().score < 0.8f) out += "Look at these first:\n";
    for (size_t i = 0; i < least.size() && i < kShown && least[i].score < 0.8f; ++i)
        out += fmt::format("  {:.0f} %  {} = {}\n", 100 * least[i].score, terminal_text(least[i].source),
                           terminal_text(least[i].target));
    out += ports_line(matching);
    if (named) out += named_ports_line(project.map.target_sets);
    out += "Wrote portmap.toml, portmap.lock and portmap.base/ in " + terminal_text(project.root) +
           "; commit all three.\n";
    if (matching.pairs.empty())
        return out +
               "Nothing is watched yet: name pairs with porttool accept SOURCE=TARGET (porttool map lists the "
               "units), or correct the globs and add --force.\n";
    return out +
           "The pairs are recorded, not verified: porttool init --assess says which say the same today.\n"
           "Next: porttool check\n";
}

/// Throws CannotDo where a file with a pair holds the marks of a merge that is not finished.
void require_finished_merges_of(const SetMatching& matching, const Project& project) {
    BySide<std::set<std::string>> files;
    for (const MatchedPair& pair : matching.pairs) {
        files.source.insert(split_id(pair.source).first);
        files.target.insert(split_id(pair.target).first);
    }
    require_finished_merges({FilesOfSide(project.source), FilesOfSide(project.target)}, files);
}

/// Looks at the pairs of a map that is there, and writes nothing.
Outcome assess_map(const Options& options, Workplace& place) {
    const Snapshot now = read_snapshot(open_project(options, place, true), {}, place.disk);
    const LockFile lock = first_lock(now.project.map, now.states);
    return {assessed_text(assess_pairs(lock, now.states, dialect_of_edits(now.project.map)), options), 0};
}

/// The pairs that the matcher finds between the sides of a map.
std::vector<NewPair> suggested_pairs(const Project& project) {
    const SetMatching matching = match_sets(project.source, project.target, settled_by(project.map),
                                            Dialect(project.map.dialect), TargetSets(project.map));
    require_finished_merges_of(matching, project);
    std::vector<NewPair> out;
    for (const MatchedPair& pair : matching.pairs)
        if (pair.state == PairState::Suggested)
            out.push_back({pair.source, pair.target, static_cast<double>(pair.score)});
    return out;
}

/// With a map that is there already: it stays as it is, and its pairs are recorded as in step. One that names its sides
/// alone gets the pairs that the matcher finds.
Outcome record_map(const Options& options, Workplace& place) {
    const auto guard = guard_lock(options, place);
    Project project = open_project(options, place, true);
    if (!options.force && place.disk.exists(lock_path(project)))
        throw CannotDo(terminal_text(lock_path(project)) +
                       " is there already; replace it with --force, or run: porttool accept");
    Snapshot now = read_snapshot(std::move(project), {}, place.disk);
    std::string map;
    if (now.project.map.pairs.empty())
        if (const std::vector<NewPair> pairs = suggested_pairs(now.project); !pairs.empty())
            map = add_pairs(now.project, pairs);
    LockFile lock = first_lock(now.project.map, now.states);
    note_macros(lock, now.files(), now.states);
    tell_differences(accept_differences(lock, now.states, dialect_of_edits(now.project.map), today()), place);
    store_lock(now.project, {lock, now.states, {}, map.empty() ? nullptr : &map, true}, place.disk);
    return {fmt::format("{} pairs of {} recorded as in step, {} source units without a port as the baseline.\n{}"
                        "Next: porttool check\n",
                        lock.pairs.size(), terminal_text(now.project.map_path), lock.baseline.size(),
                        map.empty() ? "" : "The map had none; they are suggestions: read those that are not sure.\n"),
            0, false, kLockIsWritten};
}

}  // namespace

void declare_init(Declare& declare, Options& options) {
    declare_sides(declare, options);
    declare.flag("--force", options.force, "Replace what is there");
    declare.flag("--assess", options.assess,
                 "Say of each pair whether it is a twin, equivalent, differs or is unlike today; where a map is there "
                 "already, write nothing");
}

Outcome run_init(const Options& options, Workplace& place) {
    if (options.assess)
        require_format(options.format, {"text", "json"});
    else
        require_format(options.format, {"text"});
    if (options.source.empty() && options.target.empty()) {
        const std::string map = options.config.empty()
                                    ? join_path(find_root(place.disk, options.directory), "portmap.toml")
                                    : options.config;
        if (options.config.empty() && !place.disk.exists(map))
            throw CannotDo(
                "init needs --source GLOB and --target GLOB: the files that are ported from, and their ports");
        return options.assess ? assess_map(options, place) : record_map(options, place);
    }
    if (options.assess && !options.force && options.config.empty() &&
        place.disk.exists(join_path(absolute_path(options.directory), "portmap.toml"))) {
        Options there = options;
        there.source.clear();
        there.target.clear();
        return assess_map(there, place);
    }
    Options fresh = options;
    fresh.config.clear();
    Project project = open_project(fresh, place, false);
    if (!options.config.empty()) project.map_path = clean_path(join_path(project.root, options.config));
    require_sides_beneath(project, place.disk);  // as the map will be read
    const auto guard = guard_lock(options, place);
    for (const std::string& path : {project.map_path, lock_path(project)})
        if (!options.force && place.disk.exists(path))
            throw CannotDo(terminal_text(path) +
                           " is there already; replace it with --force, or edit it and run: porttool check");
    Snapshot now = read_snapshot(std::move(project), {}, place.disk, Depth::Scanned);
    require_two_sides(now.project);
    for (const SkippedFile& file : now.project.skipped)
        place.err << "skipped " << terminal_text(file.file) << ": " << terminal_text(file.reason) << "\n";
    const bool named = now.project.map.target_sets.empty() && name_ports(now.project);
    const TargetSets sets(now.project.map);
    const SetMatching matching = match_sets(now.project.source, now.project.target, {}, Dialect(), sets);
    require_finished_merges_of(matching, now.project);
    now.states = read_states(now.project);  // not before: what the matcher needs is as large
    LockFile lock = first_lock(matching, now.states, sets);
    note_macros(lock, now.files(), now.states);
    now.project.source = now.project.target = {};  // as large as the states, and not asked for any more
    tell_differences(accept_differences(lock, now.states, Dialect(), today()), place);
    std::vector<AssessedPair> assessed;
    if (options.assess) assessed = assess_pairs(lock, now.states, Dialect());
    take_as_verified(lock, assessed);
    const std::string map = map_text(now.project, matching);
    store_lock(now.project, {lock, now.states, {}, &map, true}, place.disk);
    return {options.assess ? assessed_text(assessed, options) : summary(matching, now.project, named), 0, false,
            "portmap.toml and portmap.lock are written"};
}

}  // namespace porttool
