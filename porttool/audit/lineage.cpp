// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/lineage.h"

#include <algorithm>
#include <utility>

namespace porttool {

UnitLineage::UnitLineage(std::vector<WrittenStatement> today, bool paired) : paired_(paired), today_(std::move(today)) {
    for (size_t i = 0; i < today_.size(); ++i) {
        lines_.push_back({i, {}});
        live_.emplace(today_[i], i);
    }
}

void UnitLineage::add(const UnitEdit& edit, uint32_t commit) {
    const auto count = std::count_if(edit.places.begin(), edit.places.end(), [](const auto& one) { return !one.idle; });
    if (count > 0) commits_[commit] += static_cast<size_t>(count);
    std::vector<std::pair<std::string, size_t>> older;  // not before all places are read: one may become another's text
    for (const EditedPlace& place : edit.places) {
        if (place.now.empty()) continue;
        const auto found = live_.find(place.now);
        if (found == live_.end()) continue;
        const size_t line = found->second;
        live_.erase(found);
        lines_[line].steps.push_back({commit, place.before, !place.idle});
        if (!place.before.empty()) older.emplace_back(place.before, line);
    }
    for (const EditedPlace& place : edit.places)
        if (place.now.empty() && !place.idle && !live_.contains(place.before))
            removed_.push_back({commit, place.before});
    for (auto& [text, line] : older) live_.emplace(std::move(text), line);
}

}  // namespace porttool
