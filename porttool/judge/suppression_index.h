// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "porttool/judge/judge.h"

namespace porttool {

/// Finds the comments that settle a finding, however many there are, and remembers which did.
class SuppressionIndex {
public:
    /// `suppressions` must outlive it.
    explicit SuppressionIndex(const std::vector<PlacedSuppression>& suppressions);

    /// The last comment for a rule at a place: one of its unit, or of its file where the place is a whole file. All of
    /// them count as used.
    std::optional<size_t> use(Rule rule, const Place& place);

    bool is_used(size_t suppression) const { return used_[suppression]; }

private:
    /// The comments of one line: they belong to the same units.
    struct Group {
        std::string file;
        std::map<Rule, std::vector<size_t>> by_rule = {};  ///< those that name another settle nothing
    };

    void use_group(const Group& group, Rule rule, std::optional<size_t>& last);

    std::vector<Group> groups_;
    std::unordered_map<std::string, std::vector<size_t>> by_unit_, by_file_;
    std::map<std::tuple<Rule, std::string, std::string>, std::optional<size_t>> known_;  ///< file, id
    std::vector<bool> used_;
};

}  // namespace porttool
