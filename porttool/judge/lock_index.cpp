// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/lock_index.h"

#include <set>

namespace porttool {

LockIndex::LockIndex(const MapFile& map, const LockFile& lock, const Units& source, const Units& target)
    : source_(source), target_(target) {
    std::set<Two> mapped;
    for (const MapPair& pair : map.pairs)
        for (const std::string& id : pair.targets) mapped.insert({pair.source, id});
    for (const LockedPair& pair : lock.pairs) {
        by_ids_[{pair.source, pair.target}] = &pair;
        if (!mapped.contains({pair.source, pair.target}))
            left_over_.emplace(Two{pair.source_prints.written, pair.target_prints.written}, &pair);
    }
}

FoundLock LockIndex::find(const std::string& source, const std::string& target) const {
    if (const auto found = by_ids_.find({source, target}); found != by_ids_.end()) return {found->second, false};
    const auto left = source_.find(source), right = target_.find(target);
    if (left == source_.end() || right == target_.end()) return {};
    const auto old = left_over_.find({left->second.prints.written, right->second.prints.written});
    return old == left_over_.end() ? FoundLock{} : FoundLock{old->second, true};
}

}  // namespace porttool
