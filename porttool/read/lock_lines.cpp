// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/lock_lines.h"

namespace porttool {

LinesByPair::LinesByPair(const LockFile& lock) {
    lines_.reserve(lock.pairs.size());
    for (const LockedPair& pair : lock.pairs) lines_.emplace(IdViews(pair.source, pair.target), &pair);
}

const LockedPair* LinesByPair::find(const std::string& source, const std::string& target) const {
    const auto found = lines_.find({source, target});
    return found == lines_.end() ? nullptr : found->second;
}

}  // namespace porttool
