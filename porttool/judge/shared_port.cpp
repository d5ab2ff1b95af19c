// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/shared_port.h"

#include <algorithm>
#include <unordered_set>

namespace porttool {
SharedPorts::SharedPorts(const Case& facts, const BySide<RenamedNames>& renamed, const std::vector<MappedPair>& pairs)
    : facts_(facts),
      renamed_(renamed),
      side_(facts.map.reference == Reference::Target ? Side::Source : Side::Target),
      parts_(facts, renamed, side_) {
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

bool SharedPorts::is_original_edited(const MappedPair& pair) const {
    const UnitState* unit = pair.units[other(side_)].unit;
    return unit != nullptr && is_edit(classify(pair.recorded(other(side_)), unit->prints));
}

EditOfParts SharedPorts::edit_of(const MappedPair& pair) {
    const auto found = groups_.find(pair.units[side_].unit);
    if (found == groups_.end() || pair.lock.pair == nullptr || !is_original_edited(pair)) return {};
    const Fingerprints& then = pair.recorded(side_);
    if (!is_edit(classify(then, found->first->prints))) return {};
    std::vector<const MappedPair*> sharing;
    for (const MappedPair* one : found->second.pairs)
        if (one->recorded(side_).written == then.written) sharing.push_back(one);
    return parts_.edit_of(pair, sharing);
}

/// What a pair makes of the edit of the port: its original's edit explains it, or is told as another one. What reached
/// the part of an original that nobody edited is not explained.
SharedPorts::Worth SharedPorts::answer_of(const MappedPair& pair) {
    if (!is_original_edited(pair)) return Worth::Tell;
    FindingList said(facts_.map);
    SharedFiles files(facts_);
    const JudgedPair judged =
        PairJudge(facts_, renamed_, files, said).judge(pair.id, pair.map_line, pair.units, pair.lock);
    const EditOfParts edit = edit_of(pair);
    const bool is_of_others = edit.kind == EditOfParts::OfOthers ||
                              std::any_of(edit.owners.begin(), edit.owners.end(), [&](const MappedPair* one) {
                                  return one->units[other(side_)].unit != nullptr && !is_original_edited(*one);
                              });
    if (judged.equivalent && !is_of_others) return Worth::Explained;
    const auto all = said.from(0);
    const bool differs = std::any_of(all.begin(), all.end(), [](const Finding& finding) {
        return finding.rule == Rule::PortDiffers && finding.level != Level::Off;
    });
    return differs && !is_of_others ? Worth::Told : Worth::Tell;
}

SharedPorts::Worth SharedPorts::worth_of(const MappedPair& pair) {
    const auto found = groups_.find(pair.units[side_].unit);
    if (found == groups_.end() || pair.lock.pair == nullptr) return Worth::Tell;
    Group& group = found->second;
    const Print print = pair.recorded(side_).written;
    const auto [known, is_new] = group.answers.try_emplace(print, Worth::Tell);
    for (size_t i = 0; is_new && i < group.pairs.size() && known->second != Worth::Explained; ++i)
        if (group.pairs[i]->recorded(side_).written == print)
            known->second = std::max(known->second, answer_of(*group.pairs[i]));
    if (known->second != Worth::Tell) return known->second;
    if (group.told) return Worth::Told;
    group.told = true;
    return Worth::Tell;
}

}  // namespace porttool
