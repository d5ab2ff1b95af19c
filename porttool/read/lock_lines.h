// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>

#include "porttool/read/lock_file.h"

namespace porttool {

/// The lines of a lock by their pair. The lock outlives it.
class LinesByPair {
public:
    explicit LinesByPair(const LockFile& lock);
    /// nullptr for a pair without a line.
    const LockedPair* find(const std::string& source, const std::string& target) const;

private:
    std::map<std::pair<std::string, std::string>, const LockedPair*> lines_;
};

}  // namespace porttool
