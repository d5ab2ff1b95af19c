// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/match.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "porttool/match/assign.h"
#include "porttool/match/constants_in_use.h"
#include "porttool/match/name_cores.h"
#include "porttool/match/places.h"
#include "porttool/match/port_folders.h"
#include "porttool/read/id_patterns.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

bool by_ids(const MatchedPair& a, const MatchedPair& b) {
    return a.source != b.source ? a.source < b.source : a.target < b.target;
}

std::string id_of(const std::vector<ScannedFile>& files, const UnitFeatures& unit) {
    return unit_id(files[unit.file], files[unit.file].units[unit.unit]);
}

/// Takes the units out that are ignored, or settled without a counterpart that is here.
void keep_open_units(std::vector<UnitFeatures>& units, const std::vector<ScannedFile>& files,
                     const std::unordered_set<std::string>& hidden, const IdPatterns& ignored) {
    std::erase_if(units, [&](const UnitFeatures& unit) {
        const std::string id = id_of(files, unit);
        return hidden.contains(id) || ignored.match(id);
    });
}

std::unordered_map<std::string, uint32_t> numbers_of(const std::vector<UnitFeatures>& units,
                                                     const std::vector<ScannedFile>& files) {
    std::unordered_map<std::string, uint32_t> numbers;
    for (uint32_t i = 0; i < units.size(); ++i) numbers.emplace(id_of(files, units[i]), i);
    return numbers;
}

/// The units of both sides, without those that are out of question, and the settled pairs among them.
struct OpenUnits {
    std::vector<UnitFeatures> source, target;
    std::vector<FixedPair> fixed;
};

OpenUnits read_open_units(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target,
                          const Settled& settled, const Dialect& dialect, TermNumbers& terms) {
    const Compounds compounds(source, target);
    OpenUnits open{
        read_features(source, compounds, dialect, terms), read_features(target, compounds, dialect, terms), {}};
    std::unordered_set<std::string> hidden_source, hidden_target;
    if (!settled.pairs.empty()) {
        const auto sources = numbers_of(open.source, source), targets = numbers_of(open.target, target);
        for (const auto& [from, to] : settled.pairs)
            if (!sources.contains(from) || !targets.contains(to)) {
                hidden_source.insert(from);
                hidden_target.insert(to);
            }
    }
    const IdPatterns ignored(settled.ignored);
    keep_open_units(open.source, source, hidden_source, ignored);
    keep_open_units(open.target, target, hidden_target, ignored);
    if (settled.pairs.empty()) return open;
    const auto sources = numbers_of(open.source, source), targets = numbers_of(open.target, target);
    for (const auto& [from, to] : settled.pairs) {
        const auto s = sources.find(from);
        const auto t = targets.find(to);
        if (s != sources.end() && t != targets.end()) open.fixed.push_back({s->second, t->second});
    }
    return open;
}

void add_unmapped(std::vector<std::string>& out, const std::vector<UnitFeatures>& units,
                  const std::vector<ScannedFile>& files, const std::vector<bool>& mapped) {
    for (size_t i = 0; i < units.size(); ++i)
        if (!mapped[i]) out.push_back(id_of(files, units[i]));
    std::sort(out.begin(), out.end());
}

constexpr size_t kMostCandidates = 16;

/// Pairs the source with a target that is one port of it.
Matching match_port(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target,
                    const Settled& settled, const Dialect& dialect) {
    Matching out;
    for (const auto& [from, to] : settled.pairs) out.pairs.push_back({from, to, 1.0f, PairState::Confirmed});
    TermNumbers terms;
    OpenUnits open = read_open_units(source, target, settled, dialect, terms);
    read_cores(open.source, open.target, terms);
    weigh(open.source, open.target, terms.size());

    std::vector<bool> source_mapped(open.source.size(), false), target_mapped(open.target.size(), false);
    std::vector<bool> target_settled(open.target.size(), false);
    for (const FixedPair& pair : open.fixed) {
        source_mapped[pair.source] = target_mapped[pair.target] = true;
        target_settled[pair.target] = !settled.shares;
    }
    std::vector<UnitPair> all;
    const auto suggest = [&](const UnitPair& pair) {
        out.pairs.push_back({id_of(source, open.source[pair.source]), id_of(target, open.target[pair.target]),
                             pair.confidence, PairState::Suggested});
    };
    const bool is_whole = std::none_of(settled.pairs.begin(), settled.pairs.end(),
                                       [](const auto& pair) { return pair.first.empty() || pair.second.empty(); });
    for (const Assignment& pair :
         assign(open.source, open.target, terms, open.fixed,
                find_candidates(open.source, open.target, open.fixed, kMostCandidates), is_whole)) {
        all.push_back({pair.source, pair.target, pair.fixed ? 1.0f : pair.confidence});
        if (!pair.fixed && !target_settled[pair.target]) suggest(all.back());
    }
    for (const UnitPair& pair : find_constants_in_use(source, target, open.source, open.target, all))
        if (!source_mapped[pair.source] && !target_mapped[pair.target]) suggest(pair);
    doubt_other_places(out.pairs);
    std::unordered_set<std::string_view> mapped;
    for (const MatchedPair& pair : out.pairs) mapped.insert({pair.source, pair.target});
    for (size_t i = 0; i < open.source.size(); ++i)
        source_mapped[i] = source_mapped[i] || mapped.contains(id_of(source, open.source[i]));
    for (size_t i = 0; i < open.target.size(); ++i)
        target_mapped[i] = target_mapped[i] || mapped.contains(id_of(target, open.target[i]));
    std::sort(out.pairs.begin(), out.pairs.end(), by_ids);
    add_unmapped(out.unmapped_source, open.source, source, source_mapped);
    add_unmapped(out.unmapped_target, open.target, target, target_mapped);
    return out;
}

/// What is settled with units of these files, or with nothing that is here.
Settled settled_in(const Settled& settled, const std::vector<ScannedFile>& all, const std::vector<ScannedFile>& here) {
    std::unordered_map<std::string_view, bool> is_here;
    for (const ScannedFile& file : all) is_here[file.path] = false;
    for (const ScannedFile& file : here) is_here[file.path] = true;
    Settled out{{}, settled.ignored, settled.shares};
    for (const auto& pair : settled.pairs) {
        const auto found = is_here.find(std::string_view(pair.second).substr(0, pair.second.find(':')));
        if (found == is_here.end() || found->second) out.pairs.push_back(pair);
    }
    return out;
}

/// Makes one matching of those of several ports. What two ports use in common is told once, with its best score.
Matching merged(const std::vector<Matching>& ports) {
    std::map<std::pair<std::string, std::string>, MatchedPair> pairs;
    std::set<std::string> mapped_source, mapped_target, source, target;
    for (const Matching& port : ports) {
        for (const MatchedPair& pair : port.pairs) {
            MatchedPair& known = pairs.try_emplace({pair.source, pair.target}, pair).first->second;
            known.score = std::max(known.score, pair.score);
            mapped_source.insert(pair.source);
            mapped_target.insert(pair.target);
        }
        source.insert(port.unmapped_source.begin(), port.unmapped_source.end());
        target.insert(port.unmapped_target.begin(), port.unmapped_target.end());
    }
    Matching out;
    for (auto& [ids, pair] : pairs) out.pairs.push_back(std::move(pair));
    std::set_difference(source.begin(), source.end(), mapped_source.begin(), mapped_source.end(),
                        std::back_inserter(out.unmapped_source));
    std::set_difference(target.begin(), target.end(), mapped_target.begin(), mapped_target.end(),
                        std::back_inserter(out.unmapped_target));
    return out;
}

}  // namespace

Matching match_units(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target,
                     const Settled& settled, const Dialect& dialect) {
    const std::vector<PortFiles> ports = find_ports(source, target);
    if (ports.empty()) return match_port(source, target, settled, dialect);
    std::vector<Matching> matchings;
    for (const PortFiles& port : ports) {
        std::vector<ScannedFile> files;
        for (const uint32_t file : port.files) files.push_back(target[file]);
        matchings.push_back(match_port(source, files, settled_in(settled, target, files), dialect));
    }
    Matching out = merged(matchings);
    for (const PortFiles& port : ports) out.ports.push_back(port.name);
    return out;
}

}  // namespace porttool
