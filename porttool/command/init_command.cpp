// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "porttool/command/commands.h"
#include "porttool/judge/first_record.h"
#include "porttool/match/match.h"
#include "porttool/read/clock.h"
#include "porttool/snapshot/map_edit.h"
#include "porttool/snapshot/snapshot.h"
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
    for (const MatchedPair& pair : matching.pairs) out += pair_text({pair.source, pair.target, pair.score});
    return out;
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
    const Snapshot now = read_snapshot(std::move(project), {}, place.disk);
    LockFile lock = first_lock(now.project.map, now.states);
    tell_differences(accept_differences(lock, now.states, Dialect(now.project.map.dialect), today()), place);
    store_lock(now.project, {lock, now.states, {}, nullptr, true}, place.disk);
    return {fmt::format("{} pairs of {} recorded as in step, {} source units without a port as the baseline.\n"
                        "Next: porttool check\n",
                        lock.pairs.size(), terminal_text(now.project.map_path), lock.baseline.size()),
            0};
}

}  // namespace

void declare_init(Declare& declare, Options& options) {
    declare_sides(declare, options);
    declare.flag("--force", options.force, "Replace what is there");
}

Outcome run_init(const Options& options, Workplace& place) {
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
    Snapshot now = read_snapshot(std::move(project), {}, place.disk, Depth::Scanned);
    for (const SkippedFile& file : now.project.skipped)
        place.err << "skipped " << terminal_text(file.file) << ": " << terminal_text(file.reason) << "\n";
    const Matching matching = match_units(now.project.source, now.project.target, {}, Dialect());
    now.states = read_states(now.project);  // not before: what the matcher needs is as large
    LockFile lock = first_lock(matching, now.states);
    tell_differences(accept_differences(lock, now.states, Dialect(), today()), place);
    const std::string map = map_text(now.project, matching);
    store_lock(now.project, {lock, now.states, {}, &map, true}, place.disk);
    return {summary(matching, now.project), 0};
}

}  // namespace porttool
