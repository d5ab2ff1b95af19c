// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/match_sets.h"

#include <algorithm>
#include <iterator>

namespace porttool {
namespace {

Settled settled_in(const Settled& settled, const TargetSets& sets, const std::string& name) {
    Settled out{{}, settled.ignored, settled.shares};
    for (const auto& pair : settled.pairs)
        if (sets.of_id(pair.second) == name) out.pairs.push_back(pair);
    return out;
}

std::vector<ScannedFile> files_in(const std::vector<ScannedFile>& target, const TargetSets& sets,
                                  const std::string& name) {
    std::vector<ScannedFile> out;
    std::copy_if(target.begin(), target.end(), std::back_inserter(out),
                 [&](const ScannedFile& file) { return sets.of_path(file.path) == name; });
    return out;
}

}  // namespace

Settled settled_by(const MapFile& map) {
    Settled settled;
    for (const MapPair& pair : map.pairs)
        for (const std::string& target : pair.targets) settled.pairs.emplace_back(pair.source, target);
    for (const MapIgnore& ignore : map.ignores) settled.ignored.push_back(ignore.id);
    settled.shares = true;
    return settled;
}

SetMatching match_sets(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target,
                       const Settled& settled, const Dialect& dialect, const TargetSets& sets) {
    if (sets.names().size() == 1 && sets.names().front().empty())
        return {match_units(source, target, settled, dialect), {}};
    SetMatching out;
    std::map<std::string, std::vector<std::string>> lacking;
    for (const std::string& name : sets.names()) {
        Matching one = match_units(source, files_in(target, sets, name), settled_in(settled, sets, name), dialect);
        std::move(one.pairs.begin(), one.pairs.end(), std::back_inserter(out.pairs));
        std::move(one.unmapped_target.begin(), one.unmapped_target.end(), std::back_inserter(out.unmapped_target));
        for (const std::string& id : one.unmapped_source) lacking[id].push_back(name);
    }
    std::sort(out.pairs.begin(), out.pairs.end(), [](const MatchedPair& a, const MatchedPair& b) {
        return a.source != b.source ? a.source < b.source : a.target < b.target;
    });
    std::sort(out.unmapped_target.begin(), out.unmapped_target.end());
    for (auto& [id, names] : lacking) {
        if (names.size() == sets.names().size())
            out.unmapped_source.push_back(id);
        else
            out.missing.emplace(id, std::move(names));
    }
    return out;
}

}  // namespace porttool
