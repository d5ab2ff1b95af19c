// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/live/finding_changes.h"

#include <string_view>
#include <unordered_map>

namespace porttool {
namespace {

using ByFingerprint = std::unordered_map<std::string_view, const Finding*>;

ByFingerprint open_ones(const std::vector<Finding>& findings) {
    ByFingerprint out;
    for (const Finding& finding : findings)
        if (is_open(finding)) out.emplace(finding.fingerprint, &finding);
    return out;
}

bool is_same_place(const std::optional<Place>& a, const std::optional<Place>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return a->id == b->id && a->file == b->file && a->line == b->line && a->end_line == b->end_line;
}

bool says_the_same(const Finding& a, const Finding& b, Moves moves) {
    const bool stayed = is_same_place(a.source, b.source) && is_same_place(a.target, b.target);
    return a.level == b.level && a.change == b.change && a.message == b.message && a.remedy == b.remedy &&
           a.details == b.details && (moves == Moves::Pass || (stayed && a.map_line == b.map_line));
}

}  // namespace

FindingChanges changes_between(const std::vector<Finding>& before, const std::vector<Finding>& now, Moves moves) {
    const ByFingerprint then = open_ones(before), today = open_ones(now);
    FindingChanges out;
    for (const Finding& finding : now) {
        if (!is_open(finding)) continue;
        const auto known = then.find(finding.fingerprint);
        if (known == then.end() || !says_the_same(*known->second, finding, moves)) out.fresh.push_back(&finding);
    }
    for (const Finding& finding : before)
        if (is_open(finding) && !today.contains(finding.fingerprint)) out.gone.push_back(&finding);
    return out;
}

}  // namespace porttool
