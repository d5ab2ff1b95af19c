// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>

#include "porttool/command/commands.h"
#include "porttool/match/match_sets.h"
#include "porttool/report/map_report.h"
#include "porttool/snapshot/lock_store.h"
#include "porttool/snapshot/map_edit.h"
#include "porttool/snapshot/snapshot.h"
#include "porttool/snapshot/two_sides.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

double least_score(const std::string& text) {
    constexpr double kDefault = 0.9;
    if (text.empty()) return kDefault;
    double score = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), score);
    if (error != std::errc() || end != text.data() + text.size() || !(score >= 0 && score <= 1))
        throw CannotDo("--write " + terminal_text(text) + ": expected a score from 0 to 1, as in --write 0.8");
    return score;
}

/// Adds suggestions to the map. They are not recorded: somebody is to look at them first.
Outcome write_suggestions(Project project, const Matching& matching, double least, Workplace& place) {
    std::vector<NewPair> pairs;
    for (const MatchedPair& pair : matching.pairs)
        if (pair.state == PairState::Suggested && static_cast<double>(pair.score) >= least)
            pairs.push_back({pair.source, pair.target, static_cast<double>(pair.score)});
    if (!pairs.empty()) {
        const std::string text = add_pairs(project, pairs);
        const std::string name = project.map_path.substr(project.map_path.find_last_of('/') + 1);
        if (const std::string failure = place.disk.write(beside_map(project, name), text); !failure.empty())
            throw CannotDo(terminal_text(project.map_path) + ": " + failure);
    }
    std::string out = fmt::format("{} pairs from a score of {:g} on added to {}\n", pairs.size(), least,
                                  terminal_text(project.map_path));
    if (!pairs.empty()) out += "Look at them, then record them: porttool accept ID, or accept --all --force\n";
    return {out, 0, false, pairs.empty() ? "" : "portmap.toml is written"};
}

}  // namespace

void declare_map(Declare& declare, Options& options) {
    declare_sides(declare, options);
    declare.text_or_alone("--write", options.write, options.writes, "SCORE",
                          "Add suggestions from this score on (0.9) to portmap.toml");
}

Outcome run_map(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json"});
    const bool writes = options.writes;
    if (!writes) require_globs_or_map(options, place.disk);
    if (writes && !options.source.empty())
        throw CannotDo("--write adds to portmap.toml, which has its own sides: leave out --source and --target");
    const double least = writes ? least_score(options.write) : 0;
    const auto guard = writes ? guard_lock(options, place) : nullptr;
    const Project project = read_snapshot(open_project(options, place, true), {}, place.disk, Depth::Scanned).project;
    require_two_sides(project);
    for (const SkippedFile& file : project.skipped)
        place.err << "skipped " << terminal_text(file.file) << ": " << terminal_text(file.reason) << "\n";
    const Matching matching = match_sets(project.source, project.target, settled_by(project.map),
                                         Dialect(project.map.dialect), TargetSets(project.map));
    if (writes) return write_suggestions(project, matching, least, place);
    return {options.format == "json" ? map_json(matching) : map_table(matching), 0};
}

}  // namespace porttool
