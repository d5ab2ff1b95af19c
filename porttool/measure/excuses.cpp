// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/excuses.h"

namespace porttool {

Excuses::Excuses(const MapFile& map, const Judgement& judgement) {
    for (const MapIgnore& ignore : map.ignores) globs_.push_back({Glob(ignore.id), ignore.reason});
    for (const LoneUnit& one : judgement.lone)
        if (one.excuse) of_units_[one.side].emplace(one.unit->id, *one.excuse);
}

std::optional<std::string> Excuses::find(const std::string& id, Side side) const {
    for (const auto& [glob, reason] : globs_)
        if (glob.text() == id || glob.matches(id)) return reason;
    const auto found = of_units_[side].find(id);
    return found == of_units_[side].end() ? std::nullopt : std::optional(found->second);
}

}  // namespace porttool
