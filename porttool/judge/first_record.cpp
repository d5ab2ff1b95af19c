// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/first_record.h"

#include <set>

#include "porttool/compare/values.h"

namespace porttool {

LockFile first_lock(const SetMatching& matching, const States& states, const TargetSets& sets) {
    LockFile lock;
    for (const MatchedPair& pair : matching.pairs)
        lock.pairs.push_back(
            {pair.source, pair.target, states.source.at(pair.source).prints, states.target.at(pair.target).prints});
    for (const std::string& id : matching.unmapped_source) lock.baseline.push_back({id, states.source.at(id).prints});
    for (const auto& [id, missing] : matching.missing)
        lock.baseline.push_back(baseline_line(id, states.source.at(id).prints, Side::Source, missing, sets.names()));
    return lock;
}

LockFile first_lock(const MapFile& map, const States& states) {
    LockFile lock;
    for (const MapPair& pair : map.pairs)
        for (const std::string& target : pair.targets) {
            const auto left = states.source.find(pair.source), right = states.target.find(target);
            if (left != states.source.end() && right != states.target.end())
                lock.pairs.push_back({pair.source, target, left->second.prints, right->second.prints});
        }
    const TargetSets sets(map);
    const auto paired = paired_units(map, sets);
    for (const Side side : kBothSides) {
        if (!is_contract(map.reference, side)) continue;
        for (LockedUnit& line : baseline_of(states[side], side, paired[side], sets))
            lock.baseline.push_back(std::move(line));
    }
    return lock;
}

BySide<std::map<std::string, std::set<std::string>>> paired_units(const MapFile& map, const TargetSets& sets) {
    BySide<std::map<std::string, std::set<std::string>>> out;
    for (const MapPair& pair : map.pairs)
        for (const std::string& target : pair.targets) {
            out.source[pair.source].insert(sets.of_id(target));
            out.target[target].insert(sets.of_id(target));
        }
    return out;
}

std::vector<LockedUnit> baseline_of(const UnitsById& units, Side side,
                                    const std::map<std::string, std::set<std::string>>& paired,
                                    const TargetSets& sets) {
    std::vector<LockedUnit> out;
    if (units.size() > paired.size()) out.reserve(units.size() - paired.size());  // not twice the room on the way there
    for (const auto& [id, state] : units) {
        const auto in = paired.find(id);
        if (side == Side::Target && in != paired.end()) continue;
        std::vector<std::string> missing;
        for (const std::string& set : sets.names())
            if (in == paired.end() || !in->second.contains(set)) missing.push_back(set);
        if (!missing.empty()) out.push_back(baseline_line(id, state.prints, side, missing, sets.names()));
    }
    return out;
}

std::vector<std::string> accept_differences(LockFile& lock, const States& states, const Dialect& dialect,
                                            const std::string& today) {
    std::vector<std::string> out;
    for (const LockedPair& pair : lock.pairs) {
        const UnitState &source = states.source.at(pair.source), &target = states.target.at(pair.target);
        const bool values = source.kind == UnitKind::Constant || source.kind == UnitKind::Struct;
        if (!values || source.kind != target.kind) continue;
        const ComparedValues compared = compare_values(source.kind, source.text.words(), target.text.words(), dialect);
        if (compared.same || !compared.certain) continue;
        out.push_back(pair.source + " = " + pair.target + ": " + compared.says);
        lock.ledger.push_back({Verdict::Accept, pair.source, pair.target, source.prints.written, target.prints.written,
                               "", today, "accepted at init: " + compared.says});
    }
    return out;
}

}  // namespace porttool
