// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "porttool/read/glob.h"

namespace porttool {

/// Ids and globs of ids, as [[ignore]] has them, to be tried on many ids. What they begin with decides which are tried
/// at all, so that thousands of them cost little.
class IdPatterns {
public:
    /// Throws GlobTooLarge.
    explicit IdPatterns(const std::vector<std::string>& patterns);

    /// The patterns that match an id, ascending. Throws GlobTooLarge where too many have to be tried on too many ids.
    std::vector<size_t> matching(const std::string& id) const;
    bool match(const std::string& id) const { return !matching(id).empty(); }

private:
    std::vector<Glob> globs_;
    std::unordered_map<std::string, std::vector<size_t>> by_start_;  ///< by what stands before the first wildcard
    std::set<size_t> lengths_;                                       ///< of these
    mutable size_t tried_ = 0;
};

}  // namespace porttool
