// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/shared_port.h"

#include <algorithm>
#include <unordered_set>

namespace porttool {
namespace {

const Fingerprints* prints_of(const MappedPair& pair, Side side) {
    return side == Side::Source ? &pair.lock.pair->source_prints : &pair.lock.pair->target_prints;
}

}  // namespace

SharedPorts::SharedPorts(const Case& facts, const BySide<RenamedNames>& renamed, const std::vector<MappedPair>& pairs)
    : facts_(facts), renamed_(renamed), side_(facts.map.reference == Reference::Target ? Side::Source : Side::Target) {
    const auto is_looked_at = [&](const MappedPair& pair) {
        return pair.units[side_].unit != nullptr && pair.lock.pair != nullptr;
    };
    std::unordered_set<const UnitState*> once, several;  // most units are in one pair, and need no group
    for (const MappedPair& pair : pairs)
        if (is_looked_at(pair) && !once.insert(pair.units[side_].unit).second) several.insert(pair.units[side_].unit);
    for (const MappedPair& pair : pairs)
        if (is_looked_at(pair) && several.contains(pair.units[side_].unit))
            groups_[pair.units[side_].unit].pairs.push_back(&pair);
}

/// What a pair makes of the edit of the port: its original's edit explains it, or is told as another one.
SharedPorts::Worth SharedPorts::answer_of(const MappedPair& pair) const {
    const Side original = other(side_);
    const UnitState* unit = pair.units[original].unit;
    if (unit == nullptr || !is_edit(classify(*prints_of(pair, original), unit->prints))) return Worth::Tell;
    FindingList said(facts_.map);
    const JudgedPair judged = PairJudge(facts_, renamed_, said).judge(pair.id, pair.map_line, pair.units, pair.lock);
    if (judged.equivalent) return Worth::Explained;
    const auto all = said.from(0);
    const bool differs = std::any_of(all.begin(), all.end(), [](const Finding& finding) {
        return finding.rule == Rule::PortDiffers && finding.level != Level::Off;
    });
    return differs ? Worth::Told : Worth::Tell;
}

SharedPorts::Worth SharedPorts::worth_of(const MappedPair& pair) {
    const auto found = groups_.find(pair.units[side_].unit);
    if (found == groups_.end() || pair.lock.pair == nullptr) return Worth::Tell;
    Group& group = found->second;
    const Print print = prints_of(pair, side_)->written;
    const auto [known, is_new] = group.answers.try_emplace(print, Worth::Tell);
    for (size_t i = 0; is_new && i < group.pairs.size() && known->second != Worth::Explained; ++i)
        if (prints_of(*group.pairs[i], side_)->written == print)
            known->second = std::max(known->second, answer_of(*group.pairs[i]));
    if (known->second != Worth::Tell) return known->second;
    if (group.told) return Worth::Told;
    group.told = true;
    return Worth::Tell;
}

}  // namespace porttool
