// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "porttool/command/check_command.h"
#include "porttool/compare/constant_value.h"
#include "porttool/match/match.h"
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
    out += "source = " + list(project.map.source) + "\ntarget = " + list(project.map.target) +
           "\nreference = \"source\"\n";
    for (const MatchedPair& pair : matching.pairs)
        out += fmt::format("\n[[pair]]  # {:.0f} % sure\nsource = {}\ntarget = {}\n", 100 * pair.score,
                           toml_string(pair.source), toml_string(pair.target));
    return out;
}

LockFile first_lock(const Matching& matching, const States& states) {
    LockFile lock;
    for (const MatchedPair& pair : matching.pairs)
        lock.pairs.push_back(
            {pair.source, pair.target, states.source.at(pair.source).prints, states.target.at(pair.target).prints});
    for (const std::string& id : matching.unmapped_source) lock.baseline.push_back({id, states.source.at(id).prints});
    return lock;
}

/// A lock's first pairs are in step by definition. Those whose constants or fields certainly differ are told, and the
/// ledger keeps that they were taken over as they are.
void note_differences(LockFile& lock, const States& states, const Dialect& dialect, Workplace& place) {
    constexpr size_t kShown = 20;
    size_t differing = 0;
    for (const LockedPair& pair : lock.pairs) {
        const UnitState &source = states.source.at(pair.source), &target = states.target.at(pair.target);
        const bool values = source.kind == UnitKind::Constant || source.kind == UnitKind::Struct;
        if (!values || source.kind != target.kind) continue;
        const ComparedValues compared = compare_values_of(source, target, dialect);
        if (compared.same || !compared.certain) continue;
        if (++differing <= kShown)
            place.err << "warning: " << terminal_text(pair.source) << " = " << terminal_text(pair.target) << ": "
                      << terminal_text(compared.says) << "\n";
        lock.ledger.push_back({Verdict::Accept, pair.source, pair.target, source.prints.written, target.prints.written,
                               "", today(), "accepted at init: " + compared.says});
    }
    if (differing > kShown) place.err << "and " << differing - kShown << " more pairs that differ\n";
    if (differing > 0)
        place.err << "These are recorded as they are, with the reason 'accepted at init'; correct them now if they "
                     "should agree\n";
}

std::string summary(const Matching& matching, const Project& project) {
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
    return out + "Wrote portmap.toml, portmap.lock and portmap.base/ in " + terminal_text(project.root) +
           "; commit all three.\nNext: porttool check\n";
}

/// With a map that is there already: it stays as it is, and its pairs are recorded as in step.
Outcome record_map(const Options& options, Workplace& place) {
    const auto guard = guard_lock(options, place);
    Project project = open_project(options, place, true);
    if (!options.force && place.disk.exists(lock_path(project)))
        throw CannotDo(terminal_text(lock_path(project)) +
                       " is there already; replace it with --force, or run: porttool accept");
    read_sides(project, place);
    const States states = read_states(project);
    LockFile lock;
    std::set<std::string> mapped;
    for (const MapPair& pair : project.map.pairs) {
        mapped.insert(pair.source);
        for (const std::string& target : pair.targets) {
            const auto left = states.source.find(pair.source), right = states.target.find(target);
            if (left != states.source.end() && right != states.target.end())
                lock.pairs.push_back({pair.source, target, left->second.prints, right->second.prints});
        }
    }
    for (const auto& [id, state] : states.source)
        if (!mapped.contains(id)) lock.baseline.push_back({id, state.prints});
    note_differences(lock, states, Dialect(project.map.dialect), place);
    store_lock(project, {lock, states, {}, nullptr, true}, place.disk);
    return {fmt::format("{} pairs of {} recorded as in step, {} source units without a port as the baseline.\n"
                        "Next: porttool check\n",
                        lock.pairs.size(), terminal_text(project.map_path), lock.baseline.size()),
            0};
}

}  // namespace

Outcome init_command(const Options& options, Workplace& place) {
    require_format(options.format, {"text"});
    if (options.source.empty() && options.target.empty()) {
        const std::string map = options.config.empty()
                                    ? join_path(find_root(place.disk, options.directory), "portmap.toml")
                                    : options.config;
        if (options.config.empty() && !place.disk.exists(map))
            throw CannotDo(
                "init needs --source GLOB and --target GLOB: the files that are ported from, and their ports");
        return record_map(options, place);
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
    read_sides(project, place);
    for (const SkippedFile& file : project.skipped)
        place.err << "skipped " << terminal_text(file.file) << ": " << terminal_text(file.reason) << "\n";
    const Matching matching = match_units(project.source, project.target, {}, Dialect());
    const States states = read_states(project);
    LockFile lock = first_lock(matching, states);
    note_differences(lock, states, Dialect(), place);
    const std::string map = map_text(project, matching);
    store_lock(project, {lock, states, {}, &map, true}, place.disk);
    return {summary(matching, project), 0};
}

}  // namespace porttool
