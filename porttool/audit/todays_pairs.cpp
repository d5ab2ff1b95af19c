// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/todays_pairs.h"

#include "porttool/match/match_sets.h"
#include "porttool/snapshot/past.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

constexpr float kLikelyPair = 0.5f;  ///< of a suggestion that nobody has looked at

std::vector<TodaysPair> pairs_of_map(const MapFile& map) {
    std::vector<TodaysPair> out;
    for (const MapPair& pair : map.pairs)
        for (const std::string& target : pair.targets) out.push_back({{pair.source, target}, 1, true});
    return out;
}

std::vector<TodaysPair> matched_pairs(const Project& project) {
    const SetMatching matching = match_sets(project.source, project.target, settled_by(project.map),
                                            Dialect(project.map.dialect), TargetSets(project.map));
    std::vector<TodaysPair> out;
    for (const MatchedPair& pair : matching.pairs)
        if (pair.score >= kLikelyPair && pair.source != pair.target)
            out.push_back({{pair.source, pair.target}, static_cast<double>(pair.score), false});
    return out;
}

}  // namespace

TodaysPairs todays_pairs(const ProjectChoice& choice, Workplace& place) {
    TodaysPairs out;
    out.snapshot = read_snapshot(open_project(choice, place, true), {}, place.disk, Depth::Scanned);
    Project& project = out.snapshot.project;
    require_sides(project.map, project.map_name);
    for (const SkippedFile& file : project.skipped)
        place.err << "skipped " << terminal_text(file.file) << ": " << terminal_text(file.reason) << "\n";
    out.pairs = project.map.pairs.empty() ? matched_pairs(project) : pairs_of_map(project.map);
    out.snapshot.states = read_states(project);  // not before: what the matcher needs is as large
    std::erase_if(out.pairs, [&](const TodaysPair& pair) {
        return !out.snapshot.states.source.contains(pair.id.source) ||
               !out.snapshot.states.target.contains(pair.id.target) || pair.id.source.ends_with(":@file") ||
               pair.id.target.ends_with(":@file");
    });
    return out;
}

}  // namespace porttool
