// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/excuses.h"

namespace porttool {

Excuses::Excuses(const MapFile& map, const LockFile& lock, const Judgement& judgement) {
    for (const MapIgnore& ignore : map.ignores) globs_.push_back({Glob(ignore.id), ignore.reason});
    for (const LockedUnit& unit : lock.baseline)
        if (unit.side == "source")
            of_source_.emplace(unit.id, unit.reason.empty() ? "had no port when the baseline was taken" : unit.reason);
    for (const Finding& finding : judgement.findings)
        if (finding.rule == Rule::Unported && finding.verdict && finding.source)
            of_source_.emplace(finding.source->id, finding.verdict_reason);
}

std::optional<std::string> Excuses::find(const std::string& id, Side side) const {
    for (const auto& [glob, reason] : globs_)
        if (glob.text() == id || glob.matches(id)) return reason;
    const auto found = of_source_.find(id);
    if (side == Side::Source && found != of_source_.end()) return found->second;
    return std::nullopt;
}

}  // namespace porttool
