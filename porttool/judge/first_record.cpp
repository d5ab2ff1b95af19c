// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/first_record.h"

#include <set>

#include "porttool/compare/values.h"

namespace porttool {

LockFile first_lock(const Matching& matching, const States& states) {
    LockFile lock;
    for (const MatchedPair& pair : matching.pairs)
        lock.pairs.push_back(
            {pair.source, pair.target, states.source.at(pair.source).prints, states.target.at(pair.target).prints});
    for (const std::string& id : matching.unmapped_source) lock.baseline.push_back({id, states.source.at(id).prints});
    return lock;
}

LockFile first_lock(const MapFile& map, const States& states) {
    LockFile lock;
    BySide<std::set<std::string>> mapped;
    for (const MapPair& pair : map.pairs) {
        mapped.source.insert(pair.source);
        mapped.target.insert(pair.targets.begin(), pair.targets.end());
        for (const std::string& target : pair.targets) {
            const auto left = states.source.find(pair.source), right = states.target.find(target);
            if (left != states.source.end() && right != states.target.end())
                lock.pairs.push_back({pair.source, target, left->second.prints, right->second.prints});
        }
    }
    for (const Side side : kBothSides) {
        if (!is_contract(map.reference, side)) continue;
        for (const auto& [id, state] : states[side])
            if (!mapped[side].contains(id)) lock.baseline.push_back({id, state.prints, "", side_word(side)});
    }
    return lock;
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
