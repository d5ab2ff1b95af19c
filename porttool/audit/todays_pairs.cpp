// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/todays_pairs.h"

#include <algorithm>

#include "porttool/match/match_sets.h"
#include "porttool/scan/scan.h"
#include "porttool/snapshot/lock_store.h"
#include "porttool/snapshot/past.h"
#include "porttool/snapshot/two_sides.h"
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

/// Takes out the pairs of which somebody has said `ignore`, for the texts that they have now.
void drop_settled(TodaysPairs& today, const Disk& disk) {
    const LockFile lock = load_lock(today.snapshot.project, disk, today.snapshot.states).lock;
    std::erase_if(today.pairs, [&](const TodaysPair& pair) {
        return std::any_of(lock.ledger.begin(), lock.ledger.end(), [&](const LedgerEntry& entry) {
            return entry.verdict == Verdict::Ignore && entry.source == pair.id.source &&
                   entry.target == pair.id.target &&
                   entry.is_of(&today.unit(pair, Side::Source).prints, &today.unit(pair, Side::Target).prints);
        });
    });
}

}  // namespace

bool one_calls_the_other(const UnitState& a, const UnitState& b) {
    if (leaf_of(a.name) == leaf_of(b.name)) return false;
    const auto calls = [](const UnitState& caller, std::string_view name) {
        for (size_t i = 0; i + 1 < caller.text.size(); ++i)
            if (caller.text[i] == name && caller.text[i + 1] == "(") return true;
        return false;
    };
    return calls(a, leaf_of(b.name)) || calls(b, leaf_of(a.name));
}

TodaysPairs todays_pairs(const ProjectChoice& choice, Workplace& place) {
    TodaysPairs out;
    out.snapshot = read_snapshot(open_project(choice, place, true), {}, place.disk, Depth::Scanned);
    Project& project = out.snapshot.project;
    require_sides(project.map, project.map_name);
    require_two_sides(project);
    for (const SkippedFile& file : project.skipped)
        place.err << "skipped " << terminal_text(file.file) << ": " << terminal_text(file.reason) << "\n";
    out.pairs = project.map.pairs.empty() ? matched_pairs(project) : pairs_of_map(project.map);
    const bool of_map = !project.map.pairs.empty();
    out.snapshot.states = read_states(project);  // not before: what the matcher needs is as large
    std::erase_if(out.pairs, [&](const TodaysPair& pair) {
        return !out.snapshot.states.source.contains(pair.id.source) ||
               !out.snapshot.states.target.contains(pair.id.target) || pair.id.source.ends_with(":@file") ||
               pair.id.target.ends_with(":@file");
    });
    if (!of_map)
        std::erase_if(out.pairs, [&](const TodaysPair& pair) {
            return one_calls_the_other(out.unit(pair, Side::Source), out.unit(pair, Side::Target));
        });
    if (of_map && place.disk.exists(lock_path(project))) drop_settled(out, place.disk);
    return out;
}

}  // namespace porttool
