// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/match.h"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "porttool/match/assign.h"
#include "porttool/match/name_cores.h"
#include "porttool/read/id_patterns.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

std::string id_of(const std::vector<ScannedFile>& files, const UnitFeatures& unit) {
    return unit_id(files[unit.file], files[unit.file].units[unit.unit]);
}

/// Takes the units out that are ignored or stand in a settled pair.
void keep_open_units(std::vector<UnitFeatures>& units, const std::vector<ScannedFile>& files,
                     const std::unordered_set<std::string>& settled, const IdPatterns& ignored) {
    std::erase_if(units, [&](const UnitFeatures& unit) {
        const std::string id = id_of(files, unit);
        return settled.contains(id) || ignored.match(id);
    });
}

void add_unmapped(std::vector<std::string>& out, const std::vector<UnitFeatures>& units,
                  const std::vector<ScannedFile>& files, const std::vector<bool>& mapped) {
    for (size_t i = 0; i < units.size(); ++i)
        if (!mapped[i]) out.push_back(id_of(files, units[i]));
    std::sort(out.begin(), out.end());
}

constexpr size_t kMostCandidates = 24;

}  // namespace

Matching match_units(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target,
                     const Settled& settled, const Dialect& dialect) {
    Matching out;
    std::unordered_set<std::string> settled_source, settled_target;
    for (const auto& [from, to] : settled.pairs) {
        out.pairs.push_back({from, to, 1.0f, PairState::Confirmed});
        settled_source.insert(from);
        settled_target.insert(to);
    }
    const IdPatterns ignored(settled.ignored);

    TermNumbers terms;
    auto source_units = read_features(source, dialect, terms);
    auto target_units = read_features(target, dialect, terms);
    keep_open_units(source_units, source, settled_source, ignored);
    keep_open_units(target_units, target, settled_target, ignored);
    read_cores(source_units, target_units, terms);
    weigh(source_units, target_units, terms.size());

    std::vector<bool> source_mapped(source_units.size(), false), target_mapped(target_units.size(), false);
    const auto assignments =
        assign(source_units, target_units, terms, find_candidates(source_units, target_units, kMostCandidates));
    for (const Assignment& pair : assignments) {
        source_mapped[pair.source] = target_mapped[pair.target] = true;
        out.pairs.push_back({id_of(source, source_units[pair.source]), id_of(target, target_units[pair.target]),
                             pair.confidence, PairState::Suggested});
    }
    std::sort(out.pairs.begin(), out.pairs.end(), [](const MatchedPair& a, const MatchedPair& b) {
        return a.source != b.source ? a.source < b.source : a.target < b.target;
    });
    add_unmapped(out.unmapped_source, source_units, source, source_mapped);
    add_unmapped(out.unmapped_target, target_units, target, target_mapped);
    return out;
}

}  // namespace porttool
