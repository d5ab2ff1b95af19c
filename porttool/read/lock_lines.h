// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "porttool/read/lock_file.h"

namespace porttool {

/// Two ids of a pair, which live elsewhere.
using IdViews = std::pair<std::string_view, std::string_view>;
struct HashOfIds {
    size_t operator()(const IdViews& ids) const {
        const std::hash<std::string_view> hash;
        return hash(ids.first) * 31 + hash(ids.second);
    }
};
using SetOfIds = std::unordered_set<IdViews, HashOfIds>;

/// The lines of a lock by their pair. The lock outlives it.
class LinesByPair {
public:
    explicit LinesByPair(const LockFile& lock);
    /// nullptr for a pair without a line.
    const LockedPair* find(const std::string& source, const std::string& target) const;

private:
    std::unordered_map<IdViews, const LockedPair*, HashOfIds> lines_;
};

}  // namespace porttool
