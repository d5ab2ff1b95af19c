// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "porttool/command/commands.h"
#include "porttool/command/output_file.h"
#include "porttool/difftest/build_defines.h"
#include "porttool/difftest/difftest.h"
#include "porttool/judge/evidence.h"
#include "porttool/judge/settle.h"
#include "porttool/match/match_sets.h"
#include "porttool/read/clock.h"
#include "porttool/report/difftest_report.h"
#include "porttool/scan/scan.h"
#include "porttool/snapshot/lock_store.h"
#include "porttool/snapshot/snapshot.h"
#include "porttool/snapshot/two_sides.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/suggest.h"

namespace porttool {
namespace {

/// The pairs of the map; of a project without one, those that the matcher finds.
std::vector<PairIds> known_pairs(const Project& project, bool has_map) {
    std::vector<PairIds> out;
    if (has_map) {
        for (const MapPair& pair : project.map.pairs)
            for (const std::string& target : pair.targets) out.emplace_back(pair.source, target);
        return out;
    }
    const Matching matching = match_sets(project.source, project.target, settled_by(project.map),
                                         Dialect(project.map.dialect), TargetSets(project.map));
    for (const MatchedPair& pair : matching.pairs) out.emplace_back(pair.source, pair.target);
    return out;
}

/// The pairs that an id names. Throws CannotDo.
std::vector<PairIds> pairs_named(const std::vector<PairIds>& all, const std::string& id) {
    std::vector<PairIds> out;
    std::set<std::string> names;
    for (const PairIds& pair : all) {
        if (id == pair.first || id == pair.second || id == pair.first + "=" + pair.second) out.push_back(pair);
        names.insert({pair.first, pair.second});
    }
    if (!out.empty()) return out;
    const std::string near = nearest(id, {names.begin(), names.end()});
    throw CannotDo(terminal_text(id) + ": no such pair" +
                   (near.empty() ? std::string("; porttool map lists the pairs")
                                 : "; did you mean '" + terminal_text(near) + "'?"));
}

std::vector<PairIds> asked_pairs(const Options& options, const Project& project, const std::vector<PairIds>& all) {
    std::vector<PairIds> out;
    for (const std::string& id : options.paths)
        for (const PairIds& pair : pairs_named(all, id)) out.push_back(pair);
    if (!options.paths.empty()) return out;
    // Of constants and structs there is nothing to run; they are compared as texts.
    std::set<std::string> functions;
    for (const Side side : kBothSides)
        for (const ScannedFile& file : side == Side::Source ? project.source : project.target)
            for (const Unit& unit : file.units)
                if (unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel)
                    functions.insert(unit_id(file, unit));
    for (const PairIds& pair : all)
        if (functions.contains(pair.first) && functions.contains(pair.second)) out.push_back(pair);
    return out;
}

/// A whole number of an option. Throws CannotDo.
uint64_t whole_option(const std::string& name, const std::string& text, uint64_t otherwise, uint64_t least,
                      uint64_t most) {
    if (text.empty()) return otherwise;
    uint64_t value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || rest != text.data() + text.size() || value < least || value > most)
        throw CannotDo(name + " " + terminal_text(text) + ": expected a whole number from " + std::to_string(least) +
                       " to " + std::to_string(most));
    return value;
}

/// Throws CannotDo where one of them is none. `from`: where they stand.
void require_macros(const std::vector<std::string>& defines, const std::string& from) {
    for (const std::string& one : defines)
        if (!is_macro(one))
            throw CannotDo(from + " " + terminal_text(one) +
                           ": expected NAME or NAME=VALUE, with a value on one line without quotes, $, ;, <, > and #");
}

/// Takes the pairs that ran and gave the same as verified, in portmap.lock. Returns the line that says so.
std::string record_same(const Options& options, const DifftestResult& result, Workplace& place) {
    const auto guard = guard_lock(options, place);
    CheckedProject checked = check_project(options, place);
    const std::vector<std::string> others = other_texts({result.texts.begin(), result.texts.end()}, checked.project);
    if (!others.empty())
        throw CannotDo(terminal_line(others.front()) + " was edited meanwhile; nothing is recorded: run it again");
    if (checked.lock.version == 1)
        throw CannotDo("portmap.lock is of version 1; rewrite it once, with: porttool accept --all");
    std::set<PairIds> same;
    for (const DifftestPair& pair : result.pairs)
        if (pair.state == DifftestState::Same) same.emplace(pair.source, pair.target);
    const size_t count = verify_pairs(checked.lock, checked.judgement, same, "difftest " + today());
    if (count > 0) store_lock(checked.project, {checked.lock, checked.states, checked.texts}, place.disk);
    return std::to_string(count) + " pairs recorded as verified\n";
}

/// Nothing was found out, so that nothing goes to stdout but the JSON, which has all of the reasons.
std::string why_none_ran(const std::vector<DifftestPair>& pairs) {
    if (pairs.empty()) return "there is no pair of functions to run; name one, SOURCE=TARGET";
    const DifftestPair& first = pairs.front();
    const std::string more =
        pairs.size() == 1 ? "" : fmt::format("; {} more could not be run, see --format json", pairs.size() - 1);
    return terminal_text(first.source) + " = " + terminal_text(first.target) +
           ": not run: " + terminal_text(first.reason) + more;
}

}  // namespace

void declare_difftest(Declare& declare, Options& options) {
    declare.texts("id", options.paths, "ID",
                  "Id of either side, or SOURCE=TARGET; without any every pair of functions");
    declare_sides(declare, options);
    declare.text("--inputs", options.inputs, "N", "Inputs a pair (100000)");
    declare.text("--ulps", options.ulps, "N",
                 "How far results may be apart, in units in the last place (4); 0: to the bit");
    declare.text("--seed", options.seed, "N", "Other inputs (1)");
    declare.text("--evidence", options.evidence, "FILE", "Write what was seen, and of which texts, to FILE");
    declare.texts("--define", options.defines, "NAME[=VALUE]", "What the build defines, for every file")
        .one_at_a_time();
    declare.flag("--record", options.records,
                 "Record pairs that are in step and gave the same as verified, in portmap.lock");
    declare.text("--keep", options.keep, "DIR", "Leave the programs that were built, and their texts, in DIR");
}

Outcome run_difftest(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json"});
    constexpr uint64_t kMostInputs = 100'000'000;
    DifftestSettings settings;
    settings.inputs = whole_option("--inputs", options.inputs, settings.inputs, 1, kMostInputs);
    settings.ulps = static_cast<int>(whole_option("--ulps", options.ulps, 4, 0, 1'000'000));
    settings.seed = whole_option("--seed", options.seed, 1, 0, UINT64_MAX);
    settings.keep = options.keep;
    if (options.records && !options.source.empty())
        throw CannotDo("--record marks pairs of portmap.toml; give it without --source and --target");
    require_macros(options.defines, "--define");
    const std::string evidence = "--evidence " + terminal_text(options.evidence);
    if (!options.evidence.empty()) require_output(options, evidence, options.evidence, place.disk);
    require_globs_or_map(options, place.disk);
    const Project project = read_snapshot(open_project(options, place, true), {}, place.disk, Depth::Scanned).project;
    require_two_sides(project);
    require_macros(project.map.defines, project.map_name + ": [difftest] defines:");
    settings.defines = options.defines;
    settings.defines.insert(settings.defines.end(), project.map.defines.begin(), project.map.defines.end());
    const std::vector<PairIds> all = known_pairs(project, options.source.empty());
    const DifftestResult result = difftest(project, all, asked_pairs(options, project, all), settings, place.disk);
    for (const std::string& file : result.unread)
        place.err << "warning: " << terminal_text(file) << "; what a build defines there is not known\n";
    const std::vector<DifftestPair>& pairs = result.pairs;
    if (!options.evidence.empty())
        if (const std::string failure = place.disk.write(options.evidence, difftest_evidence(result)); !failure.empty())
            throw CannotDo(evidence + ": " + failure);
    std::string recorded;
    if (options.records) recorded = record_same(options, result, place);
    const std::string written = recorded.empty() ? "" : kLockIsWritten;
    const auto is = [](DifftestState state) {
        return [state](const DifftestPair& pair) { return pair.state == state; };
    };
    const bool differs = std::any_of(pairs.begin(), pairs.end(), is(DifftestState::Differs));
    const bool none_ran = std::all_of(pairs.begin(), pairs.end(), is(DifftestState::NotRun));
    if (options.format == "json") return {difftest_json(pairs), differs ? 1 : none_ran ? 2 : 0, false, written};
    if (none_ran) throw CannotDo(why_none_ran(pairs));
    return {difftest_table(pairs, options.verbose) + recorded, differs ? 1 : 0, false, written};
}

}  // namespace porttool
