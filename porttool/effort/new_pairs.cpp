// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/effort/new_pairs.h"

#include <set>
#include <string>

#include "porttool/effort/unit_index.h"
#include "porttool/match/match.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// The ids of units that one side has now and did not have before, under that id or another.
std::set<std::string> new_units(const std::vector<ScannedFile>& before, const std::vector<ScannedFile>& now) {
    const UnitIndex units_before(before), units_now(now);
    std::set<std::string> out;
    for (const ScannedFile& file : now)
        for (const Unit& unit : file.units) {
            const std::string id = unit_id(file, unit);
            if (units_before.find_before(id, units_now).file == nullptr) out.insert(id);
        }
    return out;
}

}  // namespace

std::vector<MapPair> pairs_of_new_code(const MapFile& map, const ChangedSides& sides) {
    constexpr float kLeastScore = 0.5f;
    const std::set<std::string> source = new_units(sides.source_before, sides.source_now),
                                target = new_units(sides.target_before, sides.target_now);
    if (source.empty() && target.empty()) return {};
    Settled settled;
    for (const MapPair& pair : map.pairs)
        for (const std::string& id : pair.targets) settled.pairs.emplace_back(pair.source, id);
    for (const MapIgnore& ignore : map.ignores) settled.ignored.push_back(ignore.id);
    std::vector<MapPair> out;
    for (const MatchedPair& pair :
         match_units(sides.source_now, sides.target_now, settled, Dialect(map.dialect)).pairs) {
        const bool is_new = source.contains(pair.source) || target.contains(pair.target);
        if (pair.state == PairState::Suggested && pair.score >= kLeastScore && is_new)
            out.push_back({pair.source, {pair.target}});
    }
    return out;
}

}  // namespace porttool
