// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/shared_port.h"

namespace porttool {
namespace {

const std::string& recorded_print(const MappedPair& pair, Side side) {
    return (side == Side::Source ? pair.lock.pair->source_prints : pair.lock.pair->target_prints).written;
}

}  // namespace

SharedPorts::SharedPorts(const Case& facts, const BySide<RenamedNames>& renamed, const std::vector<MappedPair>& pairs)
    : facts_(facts), renamed_(renamed), side_(facts.map.reference == Reference::Target ? Side::Source : Side::Target) {
    for (const MappedPair& pair : pairs)
        if (pair.units[side_].unit != nullptr && pair.lock.pair != nullptr)
            groups_[pair.units[side_].unit].pairs.push_back(&pair);
}

/// True for a pair whose two sides changed alike.
bool SharedPorts::explains(const MappedPair& pair) const {
    if (pair.units[other(side_)].unit == nullptr) return false;
    FindingList unsaid(facts_.map);
    const JudgedPair judged = PairJudge(facts_, renamed_, unsaid).judge(pair.id, pair.map_line, pair.units, pair.lock);
    const Side original = other(side_);
    const Fingerprints& then = original == Side::Source ? pair.lock.pair->source_prints : pair.lock.pair->target_prints;
    return judged.equivalent && is_edit(classify(then, pair.units[original].unit->prints));
}

SharedPorts::Worth SharedPorts::worth_of(const MappedPair& pair) {
    const auto found = groups_.find(pair.units[side_].unit);
    if (found == groups_.end() || found->second.pairs.size() < 2 || pair.lock.pair == nullptr) return Worth::Tell;
    Group& group = found->second;
    const std::string& print = recorded_print(pair, side_);
    const auto [known, is_new] = group.explained.try_emplace(print, false);
    if (is_new)
        for (const MappedPair* one : group.pairs)
            if (recorded_print(*one, side_) == print && explains(*one)) {
                known->second = true;
                break;
            }
    if (known->second) return Worth::Explained;
    if (group.told) return Worth::Told;
    group.told = true;
    return Worth::Tell;
}

}  // namespace porttool
