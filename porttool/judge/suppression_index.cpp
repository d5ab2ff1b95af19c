// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/suppression_index.h"

#include <algorithm>

namespace porttool {

SuppressionIndex::SuppressionIndex(const std::vector<PlacedSuppression>& suppressions)
    : used_(suppressions.size(), false) {
    const std::vector<std::string>* units = nullptr;
    for (size_t k = 0; k < suppressions.size(); ++k) {
        const auto& [file, comment] = suppressions[k];
        if (groups_.empty() || units != comment.units.get() || groups_.back().file != file || units == nullptr) {
            units = comment.units.get();
            by_file_[file].push_back(groups_.size());
            if (units != nullptr)
                for (const std::string& id : *units) by_unit_[id].push_back(groups_.size());
            groups_.push_back({file});
        }
        if (const auto rule = rule_named(comment.rule)) groups_.back().by_rule[*rule].push_back(k);
    }
}

std::optional<size_t> SuppressionIndex::use(Rule rule, const Place& place) {
    if (groups_.empty()) return std::nullopt;
    const bool whole_file = place.id.ends_with(":@file");
    const auto [known, fresh] = known_.try_emplace({rule, place.file, whole_file ? "" : place.id});
    if (!fresh) return known->second;
    const auto& index = whole_file ? by_file_ : by_unit_;
    if (const auto found = index.find(whole_file ? place.file : place.id); found != index.end())
        for (const size_t group : found->second)
            if (groups_[group].file == place.file) use_group(groups_[group], rule, known->second);
    return known->second;
}

void SuppressionIndex::use_group(const Group& group, Rule rule, std::optional<size_t>& last) {
    const auto found = group.by_rule.find(rule);
    if (found == group.by_rule.end()) return;
    last = std::max(last.value_or(0), found->second.back());
    if (used_[found->second.front()]) return;
    for (const size_t k : found->second) used_[k] = true;
}

}  // namespace porttool
