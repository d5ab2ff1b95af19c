// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <unordered_map>

#include "porttool/judge/finding_list.h"

namespace porttool {

/// Findings of which each is told of the first pair that has it, and counted of the others.
class ToldOnce {
public:
    /// True if that was told already; then it is counted once more.
    bool has_told(const std::string& what);
    void tell(const std::string& what, const Finding& finding);

    /// Adds to the message of each that others have what `more` says, given what was told and how many those are.
    void tell_how_many(FindingList& findings, const std::function<std::string(const std::string&, size_t)>& more) const;

private:
    struct Told {
        std::string what;
        size_t more = 0;
    };

    std::unordered_map<std::string, std::string> by_what_;  ///< fingerprints
    std::unordered_map<std::string, Told> told_;            ///< by the fingerprint
};

/// "1 more pair", "3 more pairs".
std::string more_pairs(size_t count);

}  // namespace porttool
