// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/lock_index.h"

#include <algorithm>
#include <set>

namespace porttool {

LockIndex::LockIndex(const MapFile& map, const LockFile& lock, const Units& source, const Units& target)
    : source_(source), target_(target), lines_(lock) {
    SetOfIds mapped;
    for (const MapPair& pair : map.pairs)
        for (const std::string& id : pair.targets) mapped.emplace(pair.source, id);
    for (const LockedPair& pair : lock.pairs) {
        if (!mapped.contains({pair.source, pair.target}))
            left_over_.emplace(std::pair{pair.source_prints.written, pair.target_prints.written}, &pair);
    }
}

FoundLock LockIndex::find(const std::string& source, const std::string& target) const {
    if (const LockedPair* line = lines_.find(source, target)) return {line, false};
    const auto left = source_.find(source), right = target_.find(target);
    if (left == source_.end() || right == target_.end()) return {};
    const auto old = left_over_.find({left->second.prints.written, right->second.prints.written});
    return old == left_over_.end() ? FoundLock{} : FoundLock{old->second, true};
}

void drop_idle_lines(LockFile& lock, const MapFile& map, const LockIndex::Units& source, const LockIndex::Units& target,
                     const std::vector<SkippedFile>& skipped) {
    const LockIndex index(map, lock, source, target);
    std::set<const LockedPair*> used;
    std::set<std::pair<std::string, std::string>> mapped;
    for (const MapPair& pair : map.pairs)
        for (const std::string& id : pair.targets) {
            used.insert(index.find(pair.source, id).pair);
            mapped.insert({pair.source, id});
        }
    std::vector<LockedPair> pairs;
    for (const LockedPair& pair : lock.pairs)
        if (used.contains(&pair)) pairs.push_back(pair);
    lock.pairs = std::move(pairs);

    BySide<std::set<Print>> texts;
    for (const auto& [id, unit] : source) texts.source.insert(unit.prints.written);
    for (const auto& [id, unit] : target) texts.target.insert(unit.prints.written);
    const auto is_unread = [&](const std::string& id) {
        return std::any_of(skipped.begin(), skipped.end(),
                           [&](const SkippedFile& file) { return id.starts_with(file.file + ":"); });
    };
    std::erase_if(lock.baseline, [&](const LockedUnit& unit) {
        const Side side = unit.side == side_word(Side::Source) ? Side::Source : Side::Target;
        return !(side == Side::Source ? source : target).contains(unit.id) &&
               !texts[side].contains(unit.prints.written) && !is_unread(unit.id);
    });
    std::erase_if(lock.ledger, [&](const LedgerEntry& entry) {
        if (entry.source.empty()) return !target.contains(entry.target) && !is_unread(entry.target);
        if (!entry.target.empty()) return !mapped.contains({entry.source, entry.target});
        return !source.contains(entry.source) && !is_unread(entry.source);
    });
}

}  // namespace porttool
