// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/renamed_names.h"

#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// The last part of an id's name, without the number of an overload.
std::string name_in_calls(const std::string& id) {
    const std::string name = split_id(id).second;
    return std::string(bare_leaf_of(name));
}

}  // namespace

void RenamedNames::note(const std::string& id, const Resolved& unit) {
    if (!unit.elsewhere) return;
    std::string was = name_in_calls(id), is = name_in_calls(unit.unit->id);
    if (was != is && is_word_token(was) && is_word_token(is)) names_.emplace(std::move(was), std::move(is));
}

void RenamedNames::drop_taken(const UnitsById& units) {
    if (names_.empty()) return;
    for (const auto& [id, unit] : units) names_.erase(name_in_calls(id));
}

NormalText RenamedNames::updated(NormalText before) const {
    if (names_.empty()) return before;
    NormalText out;
    bool any = false;
    for (size_t i = 0; i < before.size(); ++i) {
        const auto found = names_.find(before[i]);
        any |= found != names_.end();
        out.add(found == names_.end() ? before[i] : std::string_view(found->second));
    }
    return any ? out : before;
}

}  // namespace porttool
